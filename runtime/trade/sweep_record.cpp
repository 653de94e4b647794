#include "runtime/trade/sweep_record.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <iterator>

namespace gazeloop::trade {
namespace {

std::string settings_of(const SweepSubject& subject) {
    std::string text;
    for (const auto& [key, value] : subject.settings) {
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
    }
    return text.empty() ? "built-in settings" : text;
}

std::string words_of(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : ",") + word;
    }
    return text;
}

}  // namespace

Expected<Shard> parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto number = [&](std::size_t from, std::size_t to) -> std::size_t {
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
        return error == std::errc{} && end == text.data() + to ? value : 0;
    };
    if (slash != std::string::npos) {
        const std::size_t index = number(0, slash);
        const std::size_t count = number(slash + 1, text.size());
        if (index >= 1 && index <= count && count <= kMostSweepPoints) {
            return Shard{.index = index - 1, .count = count};
        }
    }
    return std::unexpected(
        Error{ErrorKind::Usage,
              fmt::format("'{}' is no shard: it must be I/N, with I from 1 to N and N up to {}",
                          text, kMostSweepPoints)});
}

std::string difference_of(const SweepRecord& a, const SweepRecord& b) {
    const SweepSubject& x = a.subject;
    const SweepSubject& y = b.subject;
    const auto differ = [](std::string_view what, const auto& one, const auto& other) {
        return one == other ? std::string() : fmt::format("{} is {} and {}", what, one, other);
    };
    for (const std::string& found :
         {differ("the program's version", x.program, y.program),
          differ("the device", x.device, y.device), differ("the display", x.display, y.display),
          differ("the eye", x.eye, y.eye), differ("the width", x.width_px, y.width_px),
          differ("the height", x.height_px, y.height_px),
          differ("the number of frames", x.frames, y.frames),
          differ("a frame's time", x.frame_seconds, y.frame_seconds),
          differ("the number of samples", x.samples, y.samples),
          differ("the reference's number of samples", x.reference_samples, y.reference_samples),
          differ("the number of rounds", x.rounds, y.rounds),
          differ("the peak luminance", x.peak_cd_m2, y.peak_cd_m2),
          differ("the black luminance", x.black_cd_m2, y.black_cd_m2),
          differ("the choice of metrics", words_of(x.metrics), words_of(y.metrics)),
          differ("what is set", settings_of(x), settings_of(y)),
          differ("the number of cases", a.cases.size(), b.cases.size()),
          differ("the number of points", a.points.size(), b.points.size())}) {
        if (!found.empty()) {
            return found;
        }
    }
    for (std::size_t i = 0; i < a.cases.size(); ++i) {
        if (a.cases[i] != b.cases[i]) {
            return fmt::format("case {} is {} at {} and {} at {}{}", i + 1, a.cases[i].scene,
                               a.cases[i].gaze, b.cases[i].scene, b.cases[i].gaze,
                               a.cases[i].gaze == b.cases[i].gaze ? ", looked at otherwise" : "");
        }
    }
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        if (a.points[i] != b.points[i]) {
            return fmt::format("point {} is {} {} and {} {}", i + 1, a.points[i].method,
                               a.points[i].settings_text(), b.points[i].method,
                               b.points[i].settings_text());
        }
    }
    return {};
}

Expected<SweepRecord> merged(std::vector<SweepRecord> records,
                             const std::vector<std::string>& names) {
    if (records.empty()) {
        return std::unexpected(Error{ErrorKind::Usage, "there is nothing to merge"});
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (records[i].shard == records[k].shard) {
                return std::unexpected(Error{
                    ErrorKind::BadInput,
                    fmt::format("{} and {} are both shard {} of {}: give each shard once", names[k],
                                names[i], records[i].shard.index + 1, records[i].shard.count)});
            }
        }
        if (records[i].shard.count != records.front().shard.count) {
            return std::unexpected(
                Error{ErrorKind::BadInput,
                      fmt::format("{} is one of {} shards, {} one of {}", names[0],
                                  records.front().shard.count, names[i], records[i].shard.count)});
        }
    }
    SweepRecord all = std::move(records.front());
    for (std::size_t i = 1; i < records.size(); ++i) {
        if (const std::string difference = difference_of(all, records[i]); !difference.empty()) {
            return std::unexpected(Error{
                ErrorKind::BadInput,
                fmt::format("{} and {} are not of one sweep: {}", names[0], names[i], difference)});
        }
        for (JudgedPoint& one : records[i].judged) {
            const auto there = std::ranges::find_if(all.judged, [&](const JudgedPoint& other) {
                return other.of_case == one.of_case && other.point == one.point;
            });
            if (there == all.judged.end()) {
                all.judged.push_back(std::move(one));
            } else if (there->reference_hash && one.reference_hash &&
                       there->reference_hash != one.reference_hash) {
                return std::unexpected(Error{
                    ErrorKind::BadInput,
                    fmt::format("{} and {} do not compare: full resolution of '{}' is not the "
                                "same picture in both; measure one of them again where the "
                                "scene's files and the driver are those of the other",
                                names[0], names[i], all.cases[one.of_case].scene)});
            }  // else each shard has full resolution
        }
        std::ranges::move(records[i].turns, std::back_inserter(all.turns));
        all.torn_bytes += records[i].torn_bytes;
    }
    all.shard = {};
    return all;
}

}  // namespace gazeloop::trade
