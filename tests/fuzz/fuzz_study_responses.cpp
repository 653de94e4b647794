// Any bytes as answers to a study: an error that names the file, or answers that are written and
// read back as the same, and that can be analysed.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "runtime/study/analysis.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/responses_file.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    if (size == 0) {
        return 0;
    }
    const auto& plans = study::published_plans();
    const study::Plan& plan = plans[data[0] % plans.size()];
    const auto responses =
        study::responses_of(plan, {reinterpret_cast<const char*>(data + 1), size - 1}, "fuzz");
    if (!responses) {
        require(responses.error().kind == ErrorKind::BadInput &&
                responses.error().message.starts_with("fuzz:"));
        return 0;
    }
    const std::string csv = study::responses_csv(plan, *responses);
    const auto again = study::responses_of(plan, csv, "fuzz");
    require(again.has_value() && study::responses_csv(plan, *again) == csv);
    (void)study::analyse(plan, *responses, {.resamples = 50});
    return 0;
}
