#include "runtime/trade/journal_lines.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/frame/passes.h"

namespace gazeloop::trade {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kVersionOfLines = 1;
constexpr std::size_t kMostCases = 1000;

/// PSNR of equal pictures is infinite, which JSON has no number for.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(value > 0 ? "inf" : "-inf");
}

double number(const json& value) {
    if (value.is_string()) {
        const double infinite = std::numeric_limits<double>::infinity();
        return value == "inf" ? infinite : -infinite;
    }
    return value.get<double>();
}

std::size_t index_of(const json& value, std::size_t count, const char* what) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count) {
        throw std::runtime_error(fmt::format("there is no {} {}", what, value.dump()));
    }
    return value.get<std::uint64_t>();
}

double finite_not_negative(const json& value, const char* what) {
    const auto found = value.get<double>();
    if (!(found >= 0.0) || !std::isfinite(found)) {
        throw std::runtime_error(fmt::format("{} is {}", what, value.dump()));
    }
    return found;
}

std::uint64_t views_waited_for(const json& value) {
    if (!value.is_number_unsigned()) {
        throw std::runtime_error(fmt::format("a number of views is {}", value.dump()));
    }
    return value.get<std::uint64_t>();
}

/// A whole number from 1 to `most`.
std::uint64_t count_of(const json& line, const char* key, std::uint64_t most) {
    const json& value = line.at(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() < 1 ||
        value.get<std::uint64_t>() > most) {
        throw std::runtime_error(fmt::format("{} is {}", key, value.dump()));
    }
    return value.get<std::uint64_t>();
}

/// Empty where there is none.
std::string base64_of(const json& line, const char* key) {
    std::string text = line.value(key, "");
    if (!std::ranges::all_of(text, [](unsigned char c) {
            return std::isalnum(c) != 0 || c == '+' || c == '/' || c == '=';
        })) {
        throw std::runtime_error(fmt::format("{} is not in base64", key));
    }
    return text;
}

quality::QualityFigure figure_of(const json& line) {
    return {.key = line.at("key"),
            .meaning = line.at("meaning"),
            .lower_is_better = line.at("lower_is_better"),
            .mean = number(line.at("mean")),
            .worst = number(line.at("worst")),
            .worst_frame = line.at("worst_frame")};
}

quality::ContrastShares shares_of(const json& line) {
    quality::ContrastShares shares{
        .kept = finite_not_negative(line.at("kept"), "a share"),
        .between = finite_not_negative(line.at("between"), "a share"),
        .beyond = finite_not_negative(line.at("beyond"), "a share"),
        .contrast = finite_not_negative(line.at("contrast"), "the reference's contrast")};
    if (shares.kept + shares.between + shares.beyond > 1.0 + 1e-9) {
        throw std::runtime_error("shares of contrast are over 1 together");
    }
    return shares;
}

std::uint64_t hash_of(const json& value) {
    const auto text = value.get<std::string>();
    std::uint64_t hash = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, hash, 16);
    if (error != std::errc{} || read != end) {
        throw std::runtime_error("the reference's hash is no hexadecimal number of 64 bits");
    }
    return hash;
}

JudgedPoint judged_of(const json& line, const SweepRecord& record) {
    JudgedPoint judged{.of_case = index_of(line.at("case"), record.cases.size(), "case"),
                       .point = index_of(line.at("point"), record.points.size(), "point"),
                       .error = line.value("error", "")};
    if (line.contains("contrast_shares")) {  // of sweeps of before there are none
        judged.shares = shares_of(line.at("contrast_shares"));
    }
    if (line.contains("reference")) {  // likewise
        judged.reference_hash = hash_of(line.at("reference"));
    }
    if (!judged.error.empty()) {
        return judged;
    }
    judged.cells = finite_not_negative(line.at("cells"), "the number of cells");
    judged.passes = line.at("passes").get<std::vector<std::string>>();
    if (judged.passes.size() > frame::kMostPasses) {
        throw std::runtime_error(fmt::format("{} passes", judged.passes.size()));
    }
    for (const json& figure : line.at("figures")) {
        judged.figures.push_back(figure_of(figure));
    }
    const auto before = std::ranges::find_if(
        record.judged, [](const JudgedPoint& one) { return one.error.empty(); });
    if (judged.figures.empty() ||
        (before != record.judged.end() &&
         !std::ranges::equal(judged.figures, before->figures, {}, &quality::QualityFigure::key,
                             &quality::QualityFigure::key))) {
        throw std::runtime_error("not the figures of quality that other points have");
    }
    judged.picture = base64_of(line, "picture");
    judged.heat_map = base64_of(line, "heat_map");
    return judged;
}

TimedTurn turn_of(const json& line, const SweepRecord& record) {
    TimedTurn turn{
        .of_case = index_of(line.at("case"), record.cases.size(), "case"),
        .round = static_cast<unsigned>(index_of(line.at("round"), record.subject.rounds, "round")),
        .frame = index_of(line.at("frame"), record.subject.frames, "frame")};
    // Of sweeps of before there is no energy.
    const json* const energies = line.contains("joules") ? &line.at("joules") : nullptr;
    // And where none waited for views, nothing of that.
    const json* const waits = line.contains("waited_views") ? &line.at("waited_views") : nullptr;
    for (const json& one : line.at("ms")) {
        PointTime time{.point = index_of(one.at(0), record.points.size(), "point")};
        if (energies != nullptr) {
            const json& energy = energies->at(turn.times.size());
            if (!energy.is_null()) {
                time.energy_j = finite_not_negative(energy, "a frame's energy");
            }
        }
        if (waits != nullptr) {
            time.waited_views = views_waited_for(waits->at(turn.times.size()));
        }
        for (std::size_t pass = 1; pass < one.size(); ++pass) {
            time.pass_ms.push_back(finite_not_negative(one.at(pass), "a pass's time"));
        }
        if (time.pass_ms.size() > frame::kMostPasses) {
            throw std::runtime_error(fmt::format("times of {} passes", time.pass_ms.size()));
        }
        turn.times.push_back(std::move(time));
    }
    return turn;
}

}  // namespace

std::string header_line(const SweepRecord& record) {
    const SweepSubject& subject = record.subject;
    auto settings = ordered_json::object();
    for (const auto& [key, text] : subject.settings) {
        settings[key] = text;
    }
    auto cases = ordered_json::array();
    for (const SweepCase& one : record.cases) {
        cases.push_back(
            {{"scene", one.scene}, {"gaze", one.gaze}, {"fewest_cells", one.fewest_cells}});
    }
    auto points = ordered_json::array();
    for (const SweepPoint& point : record.points) {
        auto of_point = ordered_json::array();
        for (const auto& [key, text] : point.settings) {
            of_point.push_back({key, text});
        }
        points.push_back({{"method", point.method}, {"settings", std::move(of_point)}});
    }
    return ordered_json{{"gazeloop_sweep", kVersionOfLines},
                        {"program", subject.program},
                        {"device", subject.device},
                        {"display", subject.display},
                        {"eye", subject.eye},
                        {"width_px", subject.width_px},
                        {"height_px", subject.height_px},
                        {"frames", subject.frames},
                        {"frame_seconds", subject.frame_seconds},
                        {"samples", subject.samples},
                        {"reference_samples", subject.reference_samples},
                        {"rounds", subject.rounds},
                        {"peak_cd_m2", subject.peak_cd_m2},
                        {"black_cd_m2", subject.black_cd_m2},
                        {"metrics", subject.metrics},
                        {"settings", std::move(settings)},
                        {"shard", {record.shard.index + 1, record.shard.count}},
                        {"cases", std::move(cases)},
                        {"points", std::move(points)}}
        .dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

std::string judged_line(const JudgedPoint& judged) {
    ordered_json line{{"case", judged.of_case}, {"point", judged.point}};
    if (judged.shares) {
        line["contrast_shares"] = {{"kept", judged.shares->kept},
                                   {"between", judged.shares->between},
                                   {"beyond", judged.shares->beyond},
                                   {"contrast", judged.shares->contrast}};
    }
    if (judged.reference_hash) {
        line["reference"] = fmt::format("{:016x}", *judged.reference_hash);
    }
    if (!judged.error.empty()) {
        line["error"] = judged.error;
    } else {
        line["cells"] = judged.cells;
        line["passes"] = judged.passes;
        auto figures = ordered_json::array();
        for (const quality::QualityFigure& figure : judged.figures) {
            figures.push_back({{"key", figure.key},
                               {"meaning", figure.meaning},
                               {"lower_is_better", figure.lower_is_better},
                               {"mean", number(figure.mean)},
                               {"worst", number(figure.worst)},
                               {"worst_frame", figure.worst_frame}});
        }
        line["figures"] = std::move(figures);
        if (!judged.picture.empty()) {
            line["picture"] = judged.picture;
        }
        if (!judged.heat_map.empty()) {
            line["heat_map"] = judged.heat_map;
        }
    }
    return line.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

std::string turn_line(const TimedTurn& turn) {
    auto times = ordered_json::array();
    auto energies = ordered_json::array();
    auto waits = ordered_json::array();
    bool any_energy = false;
    bool any_waits = false;
    for (const PointTime& time : turn.times) {
        any_energy |= time.energy_j.has_value();
        any_waits |= time.waited_views > 0;
        waits.push_back(time.waited_views);
        energies.push_back(time.energy_j ? ordered_json(*time.energy_j) : ordered_json());
        auto of_point = ordered_json::array({time.point});
        for (const double ms : time.pass_ms) {
            of_point.push_back(ms);
        }
        times.push_back(std::move(of_point));
    }
    ordered_json line{{"case", turn.of_case},
                      {"round", turn.round},
                      {"frame", turn.frame},
                      {"ms", std::move(times)}};
    if (any_energy) {
        line["joules"] = std::move(energies);
    }
    if (any_waits) {
        line["waited_views"] = std::move(waits);
    }
    return line.dump();
}

void read_header(const json& line, SweepRecord& record) {
    if (line.at("gazeloop_sweep") != kVersionOfLines) {
        throw std::runtime_error("its version is " + line.at("gazeloop_sweep").dump());
    }
    SweepSubject& subject = record.subject;
    line.at("program").get_to(subject.program);
    line.at("device").get_to(subject.device);
    line.at("display").get_to(subject.display);
    line.at("eye").get_to(subject.eye);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    const auto small = [&](const char* key) {
        return static_cast<std::uint32_t>(count_of(line, key, kMost));
    };
    subject.width_px = small("width_px");
    subject.height_px = small("height_px");
    subject.frames = small("frames");
    subject.frame_seconds = finite_not_negative(line.at("frame_seconds"), "a frame's time");
    subject.samples = small("samples");
    subject.reference_samples = small("reference_samples");
    subject.rounds = small("rounds");
    subject.peak_cd_m2 = finite_not_negative(line.at("peak_cd_m2"), "the peak luminance");
    subject.black_cd_m2 = finite_not_negative(line.at("black_cd_m2"), "the black luminance");
    line.at("metrics").get_to(subject.metrics);
    for (const auto& [key, text] : line.at("settings").items()) {
        subject.settings.emplace_back(key, text.get<std::string>());
    }
    const auto shard = parse_shard(
        fmt::format("{}/{}", line.at("shard").at(0).dump(), line.at("shard").at(1).dump()));
    if (!shard) {
        throw std::runtime_error(shard.error().message);
    }
    record.shard = *shard;
    for (const json& one : line.at("cases")) {
        record.cases.push_back(
            {.scene = one.at("scene"),
             .gaze = one.at("gaze"),
             .fewest_cells = finite_not_negative(one.at("fewest_cells"), "the fewest cells")});
    }
    for (const json& one : line.at("points")) {
        SweepPoint point{.method = one.at("method")};
        for (const json& setting : one.at("settings")) {
            point.settings.emplace_back(setting.at(0).get<std::string>(),
                                        setting.at(1).get<std::string>());
        }
        record.points.push_back(std::move(point));
    }
    if (record.points.empty() || record.points.front().method != "full") {
        throw std::runtime_error("its first point is not full resolution");
    }
    if (record.cases.size() > kMostCases || record.points.size() > kMostSweepPoints + 1) {
        throw std::runtime_error("it has too many cases or points");
    }
}

void read_entry(const json& line, SweepRecord& record) {
    if (line.contains("ms")) {
        record.turns.push_back(turn_of(line, record));
    } else {
        record.judged.push_back(judged_of(line, record));
    }
}

}  // namespace gazeloop::trade
