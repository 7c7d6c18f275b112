#pragma once

namespace helical::test {

/// Heap allocations of the calling thread so far, by operator new or by malloc itself (Eigen uses both). Link
/// allocation_counter.cpp into the test; not under sanitizers, which bring a malloc of their own.
long allocations();

}  // namespace helical::test
