#pragma once

#include <cstddef>

namespace gazeloop::tests {

/// How often this thread has asked for memory: malloc and its kin, operator new included.
/// Executables that ask compile allocation_counter.cpp in, which takes their place.
std::size_t allocations_of_this_thread();

}  // namespace gazeloop::tests
