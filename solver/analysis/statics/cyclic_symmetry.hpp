#pragma once

#include <vector>

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Cyclic symmetry of a model about the z axis: a rotation by 2 pi / sectors maps every block, contact and
/// load to another one. One block and one contact then represent each orbit, and a static solve has 1 /
/// sectors of the unknowns. Row numbers are those of StepProblem.
struct CyclicSymmetry {
  int sectors = 1;
  /// A block or contact as the image of the representative of its orbit.
  struct Image {
    int orbit = 0;         ///< row in the reduced problem
    int turns = 0;         ///< sectors by which the representative is rotated to this image
    bool swapped = false;  ///< contacts only: block a of the representative maps to block b of the image
  };
  std::vector<Image> blocks;          ///< (nb)
  std::vector<Image> contacts;        ///< (nc)
  std::vector<int> block_of_orbit;    ///< row of the representative (nb / sectors)
  std::vector<int> contact_of_orbit;  ///< row of the representative (nc / sectors)

  /// Rotation by `turns` sectors about z.
  Mat3 rotation(int turns) const;
};

/// Finds the image of every block and contact under a rotation by one sector. Throws InputError if the model
/// is not symmetric; the message names the cause: the position, mass or load of a block, the position, gap or
/// law of a contact, ties, or moving supports.
CyclicSymmetry find_cyclic_symmetry(const Model& model, const State& start, const ContactSet& contacts,
                                    int sectors);

}  // namespace cupola
