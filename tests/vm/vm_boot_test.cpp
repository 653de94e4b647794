// Runs the virtual machine, for the tests that look at what it found.
#include <gtest/gtest.h>

#include "tests/vm/machine.h"

namespace gazeloop::tests {
namespace {

TEST(VirtualMachine, RunsEveryCheck) {
    const std::string missing = missing_for_machine();
    skip_machine(missing);  // which also forgets the last run
    if (!missing.empty()) {
        GTEST_SKIP() << missing;
    }
    EXPECT_EQ(run_machine(), "");
}

}  // namespace
}  // namespace gazeloop::tests
