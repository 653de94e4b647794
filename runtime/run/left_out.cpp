#include "runtime/run/left_out.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::run {
namespace {

struct RanOnce {
    std::string_view pass;
    double ms;
    std::uint64_t frames_without;
};

std::vector<RanOnce> ran_once(const LeftOut& left_out, const latency::SummaryReport& report) {
    std::vector<RanOnce> passes;
    const frame::PassList& all = report.config.passes;
    for (std::size_t pass = 0; pass < all.size(); ++pass) {
        const latency::DurationRow& row = report.passes.at(pass);
        if (row.count == 1 && row.max_ms && report.frames.rendered > 1 &&
            left_out.passes.find(all[pass])) {
            passes.push_back({all[pass], *row.max_ms, report.frames.rendered - 1});
        }
    }
    return passes;
}

}  // namespace

std::string left_out_text(const LeftOut& left_out, const latency::SummaryReport& report) {
    if (left_out.parts.empty()) {
        return {};
    }
    std::string text =
        "\nleft out, since the scene does not need it (--set render.require=all shows what it "
        "costs)\n";
    for (const std::string& part : left_out.parts) {
        text += "- " + part + "\n";
    }
    for (const RanOnce& once : ran_once(left_out, report)) {
        fmt::format_to(std::back_inserter(text),
                       "  {} took {:.2f} ms in one frame, and nothing in the {} others\n",
                       once.pass, once.ms, once.frames_without);
    }
    return text;
}

nlohmann::ordered_json left_out_json(const LeftOut& left_out,
                                     const latency::SummaryReport& report) {
    nlohmann::ordered_json once = nlohmann::ordered_json::object();
    for (const RanOnce& pass : ran_once(left_out, report)) {
        once[std::string(pass.pass)] = {{"ms", pass.ms}, {"frames_without", pass.frames_without}};
    }
    return {{"parts", std::vector<std::string>(left_out.parts.begin(), left_out.parts.end())},
            {"ran_once", once}};
}

}  // namespace gazeloop::run
