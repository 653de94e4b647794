// Any bytes as a sweep's journal: refused by name, or a record of which every report can be made.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/trade/page/sweep_page.h"
#include "runtime/trade/sweep_journal.h"
#include "runtime/trade/sweep_report.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto read = trade::parse_journal(text, "fuzz");
    if (!read) {
        require(read.error().kind == ErrorKind::BadInput &&
                read.error().message.starts_with("fuzz"));
        return 0;
    }
    if (read->cases.size() * read->points.size() > 1000) {
        return 0;
    }
    trade::SweepReport report = trade::report_of(*read);
    report.with_fits = true;
    report.question = {.budget_ms = 1.0};
    require(!trade::sweep_text(report).empty() && !trade::sweep_csv(report).empty());
    require(!trade::sweep_json(report).empty() && !trade::sweep_page(report).empty());
    return 0;
}
