#pragma once

#include <vector>

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// How a model repeats around the z axis: a turn by 2 pi / sectors takes every block, contact and load to
/// another one. Then one block and one contact of each orbit stand for all, and a static solve has 1/sectors
/// of the unknowns. Rows are those of StepProblem.
struct CyclicSymmetry {
  int sectors = 1;
  /// An element of the model as the image of another: after `turns` sectors.
  struct Image {
    int orbit = 0;         ///< row in the reduced problem
    int turns = 0;         ///< of the orbit's representative
    bool swapped = false;  ///< contacts: block a of the representative goes to block b
  };
  std::vector<Image> blocks;          ///< (nb)
  std::vector<Image> contacts;        ///< (nc)
  std::vector<int> block_of_orbit;    ///< its representative (nb / sectors)
  std::vector<int> contact_of_orbit;  ///< (nc / sectors)

  /// Rotation by that many sectors about z.
  Mat3 rotation(int turns) const;
};

/// Finds the images of all blocks and contacts after a turn by one sector. Throws InputError saying what
/// breaks the symmetry: a block, its mass or its load, a contact, its gap or its law, ties, moving supports.
CyclicSymmetry find_cyclic_symmetry(const Model& model, const State& start, const ContactSet& contacts,
                                    int sectors);

}  // namespace cupola
