#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "assembly/export/export_model.hpp"

namespace cupola {

using Colour = std::array<double, 3>;  ///< red, green, blue, 0 to 1

/// Colours from the lowest to the highest value, equally spaced.
struct ColourScale {
  std::vector<Colour> stops;
  double low = 0.0, high = 1.0;
  bool below = false, above = false;  ///< there are values beyond its ends
  Colour at(double value) const;
};

/// A picture of a model in perspective, drawn by VTK. Only one may exist at a time, and it requires an X
/// display.
class Painter {
 public:
  Painter(int width, int height);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// What is added next appears between these two shares of the picture's width.
  void new_view(double left, double right);
  /// `in_front`: also where other faces would hide them.
  void add_faces(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces,
                 const std::vector<Colour>& colours, double opacity = 1.0, bool in_front = false);
  /// Edges at which two faces enclose more than 20 degrees.
  void add_edges(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces);
  /// `in_front`: also where faces would hide them.
  void add_tubes(const std::vector<std::vector<Vec3>>& lines, const Colour& colour, double radius,
                 bool in_front = false);
  /// `factor`: by which the numbers of the scale are divided.
  void add_legend(const std::string& title, const ColourScale& scale, double factor);
  void add_caption(const std::string& text);
  /// Leaves room for these points, too.
  void include(const std::vector<Vec3>& points);
  /// Looks along `direction` (towards the model) so that what was added fills the view.
  void look(const Vec3& direction, const Vec3& up);
  /// Throws SystemError.
  void save(const std::string& path);

 private:
  void fill_view();
  void add_text(const std::string& text, double height, double across = 0.5);  // shares of the view

  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace cupola
