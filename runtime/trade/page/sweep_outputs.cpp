#include "runtime/trade/page/sweep_outputs.h"

#include <array>
#include <nlohmann/json.hpp>

#include "runtime/governor/front_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/trade/measured_front.h"
#include "runtime/trade/page/sweep_page.h"

namespace gazeloop::trade {

Expected<void> check_outputs(const SweepOutputs& outputs,
                             std::span<const report::NamedFile> inputs) {
    const std::array<report::NamedFile, 5> files{{{"--csv", outputs.csv},
                                                  {"--json", outputs.json},
                                                  {"--html", outputs.html},
                                                  {"--fitted", outputs.fitted},
                                                  {"--front", outputs.front}}};
    return report::check_outputs(files, inputs);
}

Expected<void> write_outputs(const SweepReport& report, const SweepOutputs& outputs) {
    if (auto chosen = choose(report.summed_rows(), report.question); !chosen) {
        return std::unexpected(chosen.error());
    }
    const bool taken =
        outputs.csv == "-" || outputs.json == "-" || outputs.html == "-" || outputs.front == "-";
    if (outputs.text && !taken) {
        if (auto said = report::write_text("-", sweep_text(report)); !said) {
            return said;
        }
    }
    const auto write = [](const std::string& file, const auto& text_of) {
        return file.empty() ? Expected<void>{} : report::write_text(file, text_of());
    };
    if (auto done = write(outputs.csv, [&] { return sweep_csv(report); }); !done) {
        return done;
    }
    if (auto done = write(outputs.json, [&] { return report::json_text(sweep_json(report)); });
        !done) {
        return done;
    }
    if (auto done = write(outputs.html, [&] { return sweep_page(report); });
        !done || outputs.front.empty()) {
        return done;
    }
    const auto front = measured_front(report);
    if (!front) {
        return std::unexpected(front.error());
    }
    return report::write_text(outputs.front, governor::front_file(*front, front_source(report)));
}

}  // namespace gazeloop::trade
