// Any bytes as a study's plan: an error that names the file, or a plan that is written and read
// back as the same, and whose trials can be made.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "runtime/study/plan_file.h"
#include "runtime/study/trial_order.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    const auto plan = study::plan_of({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (!plan) {
        require(plan.error().kind == ErrorKind::BadInput &&
                plan.error().message.starts_with("fuzz:"));
        return 0;
    }
    const std::string text = study::plan_text(*plan);
    const auto again = study::plan_of(text, "fuzz");
    require(again.has_value() && study::plan_text(*again) == text);
    constexpr double kQuick = 2000.0;
    if (static_cast<double>(plan->cells()) * plan->sessions * plan->repeats < kQuick) {
        (void)study::trials_of(*plan, 1);
    }
    return 0;
}
