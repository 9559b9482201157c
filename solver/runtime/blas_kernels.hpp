#pragma once

namespace cupola {

/// Starts the program again, with the kernels of OpenBLAS for AVX2, if OpenBLAS does not know a processor that
/// has it: it then takes those for SSE3, with which a dome of 5,152 blocks was found to fall in 42 s, not 25.
/// Respects OPENBLAS_CORETYPE. To be called first in main.
void use_kernels_of_processor(char** argv);

}  // namespace cupola
