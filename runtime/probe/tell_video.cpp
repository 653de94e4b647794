#include "runtime/probe/tell_video.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <span>

#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::probe {

bool tell_video(const VideoQuestion& question, const std::string& json, bool quiet) {
    const report::NamedFile output{"--json", json};
    const report::NamedFile input{"the video", question.frames};
    value_or_throw(report::check_outputs(std::span{&output, 1}, std::span{&input, 1}));
    const VideoResult result =
        value_or_throw(measure_video(question, [](std::uint64_t read, std::uint64_t all) {
            constexpr std::uint64_t kEvery = 1000;
            if (read % kEvery == 0 || read == all) {
                spdlog::info("{} of {} frames read", read, all);
            }
        }));
    if (!quiet) {
        fmt::print(json == "-" ? stderr : stdout, "{}", video_text(result));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(json, report::json_text(video_json(result))));
    }
    if (result.on.trials == 0) {
        spdlog::error("the patch never went on after the lamp: nothing was measured");
        return false;
    }
    return true;
}

}  // namespace gazeloop::probe
