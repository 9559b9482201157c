#include "postproc/pictures/painter.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

vtkNew<vtkPoints> vtk_points(const std::vector<Vec3>& points) {
  vtkNew<vtkPoints> out;
  for (const Vec3& p : points) out->InsertNextPoint(p.x(), p.y(), p.z());
  return out;
}

vtkNew<vtkPolyData> vtk_faces(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces) {
  vtkNew<vtkCellArray> cells;
  for (const std::vector<int>& face : faces) {
    cells->InsertNextCell(static_cast<int>(face.size()));
    for (const int v : face) cells->InsertCellPoint(v);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(vtk_points(points));
  mesh->SetPolys(cells);
  return mesh;
}

/// Edges at which two faces enclose more than 20 degrees, or that only one face has. (vtkFeatureEdges of VTK
/// 9.1 asks for memory in proportion to the number of faces times the corners of the largest one.)
std::vector<std::pair<int, int>> sharp_edges(const std::vector<Vec3>& points,
                                             const std::vector<std::vector<int>>& faces) {
  static const double kSharp = std::cos(20.0 * EIGEN_PI / 180.0);
  std::map<std::pair<int, int>, Vec3> normal_beside;
  std::vector<std::pair<int, int>> sharp;
  for (const std::vector<int>& face : faces) {
    std::vector<Vec3> corners;
    for (const int v : face) corners.push_back(points[v]);
    const Vec3 normal = polygon_plane(corners).normal;
    for (size_t i = 0; i < face.size(); ++i) {
      const std::pair<int, int> edge = std::minmax(face[i], face[(i + 1) % face.size()]);
      const auto [other, is_new] = normal_beside.try_emplace(edge, normal);
      if (is_new) continue;
      if (other->second.dot(normal) < kSharp) sharp.push_back(edge);
      normal_beside.erase(other);
    }
  }
  for (const auto& [edge, normal] : normal_beside) sharp.push_back(edge);
  return sharp;
}

}  // namespace

Colour ColourScale::at(double value) const {
  constexpr Colour kUndefined{0.59, 0.59, 0.59};
  if (!std::isfinite(value)) return kUndefined;
  const double last = static_cast<double>(stops.size()) - 1.0;
  const double x = high > low ? last * std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
  const size_t i = std::min(static_cast<size_t>(x), stops.size() - 2);
  const double f = x - static_cast<double>(i);
  Colour out{};
  for (size_t k = 0; k < 3; ++k) out[k] = (1.0 - f) * stops[i][k] + f * stops[i + 1][k];
  return out;
}

struct Painter::Scene {
  vtkNew<vtkRenderWindow> window;
  vtkRenderer *view = nullptr, *front = nullptr;  // the last one, and its layer in front; owned by the window
  std::vector<Vec3> points;                       // of the last view
  bool has_text = false;                          // below it

  vtkActor* add(vtkPolyDataMapper* mapper, bool in_front = false) {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    (in_front ? front : view)->AddActor(actor);
    return actor;
  }
};

Painter::Painter(int width, int height) : scene_(std::make_unique<Scene>()) {
  scene_->window->SetOffScreenRendering(1);
  scene_->window->SetMultiSamples(4);
  scene_->window->SetNumberOfLayers(2);
  scene_->window->SetSize(width, height);
  new_view(0.0, 1.0);
}
Painter::~Painter() = default;

void Painter::new_view(double left, double right) {
  if (scene_->view != nullptr && scene_->view->GetActors()->GetNumberOfItems() == 0)
    scene_->window->RemoveRenderer(scene_->view);
  vtkNew<vtkRenderer> view, front;
  for (vtkRenderer* layer : {view.Get(), front.Get()}) {
    layer->SetViewport(left, 0.0, right, 1.0);
    layer->SetBackground(1.0, 1.0, 1.0);
    scene_->window->AddRenderer(layer);
  }
  front->SetLayer(1);
  front->SetActiveCamera(view->GetActiveCamera());
  scene_->view = view;
  scene_->front = front;
  scene_->points.clear();
  scene_->has_text = false;
}

void Painter::add_faces(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces,
                        const std::vector<Colour>& colours, double opacity, bool in_front) {
  include(points);
  const vtkNew<vtkPolyData> mesh = vtk_faces(points, faces);
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetNumberOfComponents(3);
  for (const Colour& c : colours) bytes->InsertNextTuple3(255.0 * c[0], 255.0 * c[1], 255.0 * c[2]);
  mesh->GetCellData()->SetScalars(bytes);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkProperty* look = scene_->add(mapper, in_front)->GetProperty();
  look->SetInterpolationToFlat();
  look->SetAmbient(0.42);
  look->SetDiffuse(0.7);
  look->SetOpacity(opacity);
}

void Painter::add_edges(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces) {
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : sharp_edges(points, faces)) {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(a);
    cells->InsertCellPoint(b);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(vtk_points(points));
  mesh->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -4.0);
  vtkProperty* look = scene_->add(mapper)->GetProperty();
  look->SetColor(0.2, 0.18, 0.16);
  // As dark as with few blocks: beyond, edges would cover the faces.
  constexpr double kFewEdges = 100000.0;
  look->SetLineWidth(1.6F);
  look->SetOpacity(std::min(1.0, kFewEdges / static_cast<double>(cells->GetNumberOfCells())));
  look->LightingOff();
}

void Painter::add_tubes(const std::vector<std::vector<Vec3>>& lines, const Colour& colour, double radius,
                        bool in_front) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const std::vector<Vec3>& line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Vec3& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.x(), p.y(), p.z()));
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetLines(cells);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(mesh);
  tube->SetRadius(radius);
  tube->SetNumberOfSides(8);
  tube->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  vtkProperty* look = scene_->add(mapper, in_front)->GetProperty();
  look->SetColor(colour[0], colour[1], colour[2]);
  look->SetAmbient(0.4);
}

void Painter::add_legend(const std::string& title, const ColourScale& scale, double factor) {
  constexpr int kColours = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(kColours);
  table->SetTableRange(scale.low / factor, scale.high / factor);
  for (int i = 0; i < kColours; ++i) {
    const Colour c = scale.at(scale.low + (scale.high - scale.low) * i / (kColours - 1));
    table->SetTableValue(i, c[0], c[1], c[2]);
  }
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetMaximumNumberOfColors(kColours);
  bar->SetTitle("");
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(scale.low < 0.0 ? 5 : 3);
  bar->SetLabelFormat("%.4g");
  bar->SetUnconstrainedFontSize(true);
  vtkTextProperty* text = bar->GetLabelTextProperty();
  text->SetColor(0.1, 0.1, 0.1);
  text->SetFontSize(26);
  text->ItalicOff();
  text->BoldOff();
  text->ShadowOff();
  bar->SetPosition(0.25, 0.015);
  bar->SetWidth(0.5);
  bar->SetHeight(0.075);
  scene_->view->AddActor2D(bar);
  constexpr double kBesideBar = 0.015, kLeft = 0.235, kRight = 0.765;
  if (scale.below) add_text("≤", kBesideBar, kLeft);
  if (scale.above) add_text("≥", kBesideBar, kRight);
  add_text(title, 0.105);
}

void Painter::add_caption(const std::string& text) {
  add_text(text, 0.04);
}

void Painter::add_text(const std::string& text, double height, double across) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetFontSize(26);
  actor->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(across, height);
  scene_->view->AddActor2D(actor);
  scene_->has_text = true;
}

void Painter::look(const Vec3& direction, const Vec3& up) {
  vtkCamera* camera = scene_->view->GetActiveCamera();
  camera->SetViewAngle(20.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  const Vec3 eye = -direction.normalized();
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(up.x(), up.y(), up.z());
  scene_->view->ResetCamera();
  fill_view();
  scene_->view->RemoveAllLights();
  for (const auto& [x, y, strength] : {std::tuple{0.0, 0.3, 0.5}, {-0.8, 1.2, 0.4}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, 1.0);
    light->SetIntensity(strength);
    scene_->view->AddLight(light);
  }
  scene_->front->SetLightCollection(scene_->view->GetLights());
  scene_->view->ResetCameraClippingRange();
}

void Painter::include(const std::vector<Vec3>& points) {
  scene_->points.insert(scene_->points.end(), points.begin(), points.end());
}

void Painter::fill_view() {
  constexpr double kShare = 0.94;                      // of the view, without the text below
  const double low = scene_->has_text ? -0.70 : -1.0;  // the view spans -1 to 1
  vtkCamera* camera = scene_->view->GetActiveCamera();
  const Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> to_view(
      &camera->GetCompositeProjectionTransformMatrix(scene_->view->GetTiledAspectRatio(), -1.0, 1.0)
           ->Element[0][0]);
  Eigen::AlignedBox<double, 2> box;
  for (const Vec3& p : scene_->points) {
    const Eigen::Vector4d q = to_view * p.homogeneous();
    box.extend(Eigen::Vector2d(q.x() / q.w(), q.y() / q.w()));
  }
  if (box.isEmpty() || box.diagonal().minCoeff() <= 0.0) return;
  const double zoom = kShare * std::min(2.0 / box.sizes().x(), (1.0 - low) / box.sizes().y());
  camera->Zoom(zoom);
  // The centre of the window is given in half windows, against the direction in which the picture moves.
  camera->SetWindowCenter(zoom * box.center().x(), zoom * box.center().y() - 0.5 * (1.0 + low));
}

void Painter::save(const std::string& path) {
  scene_->window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene_->window);
  grab->SetReadFrontBuffer(false);
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(grab->GetOutputPort());
  png->SetFileName(path.c_str());
  png->Write();
  if (png->GetErrorCode() != 0) throw SystemError(fmt::format("{}: cannot be written", path));
}

}  // namespace cupola
