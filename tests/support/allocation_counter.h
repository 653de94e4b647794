#pragma once

#include <cstddef>

namespace gazeloop::tests {

/// How often this thread has called operator new. Executables that ask compile
/// allocation_counter.cpp in, which replaces it.
std::size_t allocations_of_this_thread();

}  // namespace gazeloop::tests
