#include "runtime/governor/level_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gazeloop::governor {
namespace {

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void LevelAccount::on_frame(const frame::FrameRecord& record) {
    // A damaged recording may name a level that its front does not have.
    if (!record.should_render || !record.quality_level ||
        *record.quality_level >= front_.levels.size()) {
        return;
    }
    const std::size_t level = *record.quality_level;
    ++levels_[level].frames;
    changes_ += last_ && *last_ != level ? 1 : 0;
    last_ = level;
    under_way_[record.index % kUnderWay] = {record.index, level, record.period_ns};
}

void LevelAccount::on_gpu(const frame::FrameGpuRecord& record) {
    const UnderWay& drawn = under_way_[record.index % kUnderWay];
    if (drawn.frame != record.index || drawn.level == kMostLevels || drawn.period_ns <= 0 ||
        !record.gpu_begin.known() || !record.gpu_end.known()) {
        return;
    }
    ++levels_[drawn.level].timed;
    levels_[drawn.level].within +=
        record.gpu_end.ns - record.gpu_begin.ns <= drawn.period_ns ? 1 : 0;
}

LevelAccount::OfLevel LevelAccount::all() const {
    OfLevel sum;
    for (const OfLevel& one : levels_) {
        sum.frames += one.frames;
        sum.timed += one.timed;
        sum.within += one.within;
    }
    return sum;
}

std::string LevelAccount::text() const {
    const OfLevel sum = all();
    if (sum.frames == 0) {
        return "the governor drew nothing: no frame was rendered\n";
    }
    const auto most = static_cast<std::size_t>(
        std::ranges::max_element(levels_, {}, &OfLevel::frames) - levels_.begin());
    const Level& level = front_.levels[most];
    std::string text = fmt::format(
        "the governor held level {} of {}: {} ({} {:.3g} where its front was "
        "measured), in {:.1f} % of frames; {} change{}",
        most + 1, front_.levels.size(), level.text(), front_.figure, level.loss,
        percent(levels_[most].frames, sum.frames), changes_, changes_ == 1 ? "" : "s");
    text += sum.timed == 0 ? "; how long frames took is unknown"
                           : fmt::format(
                                 "; {:.1f} % of frames took no longer than the display's "
                                 "period",
                                 percent(sum.within, sum.timed));
    return text + "\n";
}

nlohmann::ordered_json LevelAccount::json() const {
    using Json = nlohmann::ordered_json;
    Json levels = Json::array();
    for (std::size_t at = 0; at < front_.levels.size(); ++at) {
        const Level& level = front_.levels[at];
        const OfLevel& drawn = levels_[at];
        levels.push_back({{"level", at},
                          {"drawn_by", level.text()},
                          {"loss", level.loss},
                          {"frames", drawn.frames},
                          {"timed", drawn.timed},
                          {"within_period", drawn.timed > 0 ? Json(drawn.within) : Json(nullptr)}});
    }
    return {{"figure", front_.figure}, {"changes", changes_}, {"levels", levels}};
}

}  // namespace gazeloop::governor
