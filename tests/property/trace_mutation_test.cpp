// Good traces, mutated in ways that users' files are, through both readers: what can be used is
// used, what cannot is refused or in the report. GAZELOOP_MUTATIONS says how many for each reader.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/trace/native_trace.h"
#include "drivers/trace/read_trace.h"
#include "sim/gaze_generator.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using Cells = std::vector<std::string>;
using Random = std::mt19937_64;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::size_t kWindow = 64;

std::size_t mutations() {
    constexpr std::size_t kDefault = 400;
    const char* const text = std::getenv("GAZELOOP_MUTATIONS");
    return text != nullptr ? std::strtoull(text, nullptr, 10) : kDefault;
}

std::size_t below(Random& random, std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
}
std::int64_t between(Random& random, std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random);
}

/// A file's table, and where its time stands.
struct Table {
    char separator = ',';
    Cells header;
    std::vector<Cells> rows;
    std::size_t time = 0;
    std::int64_t tick_ns = 1;
    bool numbered = false;

    [[nodiscard]] std::size_t column(std::string_view name) const {
        return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) -
                                        header.begin());
    }
    [[nodiscard]] std::int64_t time_ns(std::size_t row) const {
        return std::stoll(rows[row][time]) * tick_ns;
    }
    void set_time_ns(std::size_t row, std::int64_t ns) {
        rows[row][time] = std::to_string(ns / tick_ns);
    }
    [[nodiscard]] std::string text() const {
        std::string all = fmt::format("{}\n", fmt::join(header, std::string(1, separator)));
        for (const Cells& row : rows) {
            all += fmt::format("{}\n", fmt::join(row, std::string(1, separator)));
        }
        return all;
    }
};

Cells split(const std::string& line, char separator) {
    Cells cells;
    std::string cell;
    std::istringstream in(line);
    while (std::getline(in, cell, separator)) {
        cells.push_back(cell);
    }
    if (!line.empty() && line.back() == separator) {
        cells.emplace_back();
    }
    return cells;
}

gaze::GazeTrace person(std::uint64_t seed) { return sim::generate_gaze({.seed = seed}, 3.0); }

Table native(std::uint64_t seed) {
    std::ostringstream out;
    write_native_trace(person(seed), out);
    std::istringstream in(out.str());
    std::string line;
    std::getline(in, line);
    Table table;
    table.header = split(line, ',');
    table.numbered = true;
    while (std::getline(in, line)) {
        table.rows.push_back(split(line, ','));
    }
    table.time = table.column("t_device_ns");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.set_time_ns(i, table.time_ns(i) + 100 * kSecond_ns);
    }
    return table;
}

Table htc(std::uint64_t seed) {
    Table table;
    table.separator = ';';
    table.tick_ns = 100;
    table.header = split(
        "time(100ns);eye_valid_L;eye_valid_R;openness_L;openness_R;"
        "gaze_origin_L.x(mm);gaze_origin_L.y(mm);gaze_origin_L.z(mm);"
        "gaze_origin_R.x(mm);gaze_origin_R.y(mm);gaze_origin_R.z(mm);"
        "gaze_direct_L.x;gaze_direct_L.y;gaze_direct_L.z;"
        "gaze_direct_R.x;gaze_direct_R.y;gaze_direct_R.z",
        ';');
    for (const gaze::GazeSample& sample : person(seed).samples) {
        Cells cells{std::to_string(1'000'000'000 + sample.sampled.ns / 100)};
        for (const gaze::EyeRay& ray : sample.eyes) {
            cells.emplace_back(ray.valid ? "31" : "0");
        }
        for (const gaze::EyeRay& ray : sample.eyes) {
            cells.push_back(fmt::format("{}", ray.openness));
        }
        for (const gaze::EyeRay& ray : sample.eyes) {
            cells.push_back(fmt::format("{}", -1e3 * ray.origin_m.x));
            cells.push_back(fmt::format("{}", 1e3 * ray.origin_m.y));
            cells.push_back(fmt::format("{}", -1e3 * ray.origin_m.z));
        }
        for (const gaze::EyeRay& ray : sample.eyes) {
            cells.push_back(fmt::format("{}", ray.valid ? -ray.direction.x : 0.0));
            cells.push_back(fmt::format("{}", ray.valid ? ray.direction.y : 0.0));
            cells.push_back(fmt::format("{}", ray.valid ? -ray.direction.z : 0.0));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

/// What a mutated trace deserves.
struct Deserved {
    std::string mutation;                 ///< what was done
    std::size_t used = 0;                 ///< rows, at least
    bool refused = false;                 ///< the file as a whole
    std::vector<TraceFindingKind> found;  ///< among the findings
    std::size_t lost = 0;                 ///< by the tracker, where rows are numbered
};

using Mutate = Deserved (*)(Table& table, Random& random);

std::size_t inner(const Table& table, Random& random) {
    constexpr std::size_t kMargin = 40;
    return kMargin + below(random, table.rows.size() - 2 * kMargin);
}

Deserved drop_rows(Table& table, Random& random) {
    const std::size_t at = inner(table, random);
    const std::size_t count = 1 + below(random, 30);
    const auto first = table.rows.begin() + static_cast<std::ptrdiff_t>(at);
    table.rows.erase(first, first + static_cast<std::ptrdiff_t>(count));
    return {
        fmt::format("{} rows from {} on dropped", count, at), table.rows.size(), false, {}, count};
}

Deserved repeat_row(Table& table, Random& random) {
    const std::size_t used = table.rows.size();
    std::size_t at = inner(table, random);
    const std::size_t valid = table.column(table.numbered ? "left_valid" : "eye_valid_L");
    while (table.rows[at][valid] == "0") {  // closed eyes of unnumbered rows are all alike
        at = inner(table, random);
    }
    const std::size_t later = 1 + below(random, 30);
    table.rows.insert(table.rows.begin() + static_cast<std::ptrdiff_t>(at + later),
                      Cells(table.rows[at]));
    return {fmt::format("row {} repeated {} rows later", at, later),
            used,
            false,
            {TraceFindingKind::Repeat},
            0};
}

Deserved shuffle_window(Table& table, Random& random) {
    const std::size_t at = inner(table, random) - 20;
    const std::size_t count = std::min(2 + below(random, kWindow - 1), table.rows.size() - at);
    const auto first = table.rows.begin() + static_cast<std::ptrdiff_t>(at);
    std::shuffle(first, first + static_cast<std::ptrdiff_t>(count), random);
    std::swap(table.rows[at], table.rows[at + count - 1]);
    bool mixed = false;
    for (std::size_t i = 1; i < table.rows.size(); ++i) {
        mixed = mixed || table.time_ns(i) < table.time_ns(i - 1);
    }
    Deserved deserved{
        fmt::format("{} rows from {} on shuffled", count, at), table.rows.size(), false, {}, 0};
    if (mixed) {
        deserved.found = {TraceFindingKind::OutOfOrder};
    }
    return deserved;
}

Deserved spike(Table& table, Random& random) {
    const std::size_t at = below(random, table.rows.size());
    const std::int64_t by =
        between(random, 2 * kSecond_ns, 40 * kSecond_ns) * (below(random, 2) == 0 ? 1 : -1);
    table.set_time_ns(at, table.time_ns(at) + by);
    return {fmt::format("row {} moved by {} ns", at, by),
            table.rows.size() - 1,
            false,
            {TraceFindingKind::TimeOutlier},
            0};
}

Deserved step_back(Table& table, Random& random) {
    const std::size_t at = inner(table, random);
    const std::int64_t by = between(random, kSecond_ns, 50 * kSecond_ns);
    for (std::size_t i = at; i < table.rows.size(); ++i) {
        table.set_time_ns(i, table.time_ns(i) - by);
    }
    return {fmt::format("clock set back by {} ns at row {}", by, at),
            table.rows.size(),
            false,
            {TraceFindingKind::DeviceClockSet},
            0};
}

Deserved wrap(Table& table, Random& random) {
    const std::int64_t range = std::int64_t{below(random, 2) == 0 ? 1'000 : 1'000'000} << 32;
    const std::size_t at = inner(table, random);
    const std::int64_t shift = range - table.time_ns(at);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.set_time_ns(i, (table.time_ns(i) + shift) % range);
    }
    return {fmt::format("counter of {} ns wraps at row {}", range, at),
            table.rows.size(),
            false,
            {TraceFindingKind::CounterWrapped},
            0};
}

Deserved coarsen(Table& table, Random& random) {
    const std::int64_t step = between(random, 17, 40) * 1'000'000;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.set_time_ns(i, table.time_ns(i) / step * step);
    }
    return {fmt::format("times in steps of {} ns", step),
            table.rows.size(),
            false,
            {TraceFindingKind::CoarseTimes},
            0};
}

Deserved negate_axis(Table& table, Random& random) {
    const char axis = "xyz"[below(random, 3)];
    for (const bool left : {true, false}) {
        const std::size_t column =
            table.column(table.numbered ? fmt::format("{}_{}", left ? "left" : "right", axis)
                                        : fmt::format("gaze_direct_{}.{}", left ? 'L' : 'R', axis));
        for (Cells& row : table.rows) {
            std::string& cell = row[column];
            if (cell.starts_with('-')) {
                cell.erase(0, 1);
            } else if (!cell.empty()) {
                cell.insert(0, 1, '-');
            }
        }
    }
    // Behind the head no gaze is; left and right exchanged makes eyes diverge; up and down nobody
    // can tell.
    Deserved deserved{fmt::format("{} negated", axis), table.rows.size(), axis == 'z', {}, 0};
    if (axis == 'x') {
        deserved.found = {TraceFindingKind::Axes};
    }
    return deserved;
}

Deserved swap_eyes(Table& table, Random&) {
    for (std::string& name : table.header) {
        const auto swapped = [&](std::string_view a, std::string_view b) {
            if (const std::size_t found = name.find(a); found != std::string::npos) {
                name.replace(found, a.size(), b);
                return true;
            }
            return false;
        };
        const bool was_left = table.numbered ? swapped("left_", "right_") : swapped("_L", "_R");
        if (!was_left) {
            swapped(table.numbered ? "right_" : "_R", table.numbered ? "left_" : "_L");
        }
    }
    return {"eyes swapped", table.rows.size(), false, {TraceFindingKind::Axes}, 0};
}

Deserved put_nan(Table& table, Random& random) {
    const std::size_t at = below(random, table.rows.size());
    const std::size_t column = table.column(table.numbered ? "left_y" : "gaze_direct_L.y");
    const std::size_t valid = table.column(table.numbered ? "left_valid" : "eye_valid_L");
    table.rows[at][column] = "nan";
    Deserved deserved{fmt::format("nan in row {}", at), table.rows.size(), false, {}, 0};
    if (table.rows[at][valid] != "0") {  // of an eye that the row itself calls invalid, it is blank
        deserved.found = {TraceFindingKind::BadCells};
    }
    return deserved;
}

constexpr std::array<Mutate, 10> kMutations{drop_rows, repeat_row, shuffle_window, spike,
                                            step_back, wrap,       coarsen,        negate_axis,
                                            swap_eyes, put_nan};

void expect_promises_kept(const gaze::GazeTrace& trace, std::size_t rows) {
    ASSERT_FALSE(trace.samples.empty());
    EXPECT_EQ(trace.report.rows, rows) << "each row is accounted for";
    EXPECT_EQ(trace.samples.size() + trace.report.rows_dropped(), trace.report.rows);
    for (std::size_t i = 1; i < trace.samples.size(); ++i) {
        ASSERT_LT(trace.samples[i - 1].sampled.ns, trace.samples[i].sampled.ns) << i;
        ASSERT_LT(trace.samples[i - 1].sequence, trace.samples[i].sequence) << i;
    }
}

void expect_deserved(const Table& table, const Deserved& deserved) {
    std::istringstream in(table.text());
    const Expected<gaze::GazeTrace> trace = read_trace(in, "mutated");
    if (!trace) {
        EXPECT_EQ(trace.error().kind, ErrorKind::BadInput);
        EXPECT_NE(trace.error().message.find("mutated"), std::string::npos);
        EXPECT_TRUE(deserved.refused) << trace.error().message;
        return;
    }
    EXPECT_FALSE(deserved.refused) << "it was read";
    expect_promises_kept(*trace, table.rows.size());
    EXPECT_GE(trace->samples.size(), deserved.used);
    if (table.numbered) {
        EXPECT_EQ(trace->report.lost_by_tracker, deserved.lost);
    }
    for (const TraceFindingKind kind : deserved.found) {
        EXPECT_GT(trace->report.count(kind).times, 0U)
            << gaze::kTraceFindingNames[static_cast<std::size_t>(kind)];
    }
    // The usual span of time too, unless the rows at an end are those that are missing.
    const double length_s = static_cast<double>(trace->samples.back().sampled.ns) * 1e-9;
    EXPECT_NEAR(length_s, 3.0, 0.06);
}

void expect_cut_is_told(const std::string& text, std::size_t at) {
    const std::string kept = text.substr(0, at);
    const bool in_a_line = !kept.empty() && kept.back() != '\n';
    const auto ends = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), '\n'));
    std::istringstream in(kept);
    const Expected<gaze::GazeTrace> trace = read_trace(in, "mutated");
    if (!trace) {
        EXPECT_NE(trace.error().message.find("mutated"), std::string::npos);
        // Too little is left to play, or to tell a clock by.
        constexpr std::size_t kFew = 12;
        EXPECT_LT(ends, kFew) << trace.error().message;
        return;
    }
    expect_promises_kept(*trace, ends - 1 + (in_a_line ? 1 : 0));
}

class TraceMutation : public ::testing::TestWithParam<Table (*)(std::uint64_t seed)> {};

TEST_P(TraceMutation, GetsWhatItDeserves) {
    const std::size_t count = mutations();
    for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
        Random random(i);
        const std::uint64_t seed = i % 16;
        Table table = GetParam()(seed);
        const std::size_t which = i % (kMutations.size() + 1);
        if (which == kMutations.size()) {
            const std::string text = table.text();
            const std::size_t at = below(random, text.size());
            SCOPED_TRACE(fmt::format("mutation {}, person {}: cut after {} bytes", i, seed, at));
            expect_cut_is_told(text, at);
            continue;
        }
        const Deserved deserved = kMutations[which](table, random);
        SCOPED_TRACE(fmt::format("mutation {}, person {}: {}", i, seed, deserved.mutation));
        expect_deserved(table, deserved);
    }
}

INSTANTIATE_TEST_SUITE_P(Native, TraceMutation, ::testing::Values(native));
INSTANTIATE_TEST_SUITE_P(HtcVivePro, TraceMutation, ::testing::Values(htc));

}  // namespace
}  // namespace gazeloop::drivers
