#include "drivers/trace/companion_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <utility>

#include "drivers/trace/text/csv_table.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

std::ifstream open_beside(const TraceFile& trace, std::string_view name, std::string& found) {
    for (const std::string_view ending : {"", ".gz"}) {
        found = (trace.parent_path() / fmt::format("{}{}", name, ending)).string();
        if (std::ifstream in(found, std::ios::binary); in) {
            return in;
        }
    }
    return std::ifstream{};
}

/// In the order of their times, which few recorders do not keep.
void sort_by_time(TimedNumbers& table) {
    if (std::ranges::is_sorted(table.time_ns)) {
        return;
    }
    memory::LongVector<std::size_t> order(table.time_ns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // A stable sort would take memory for half of them.
    std::ranges::sort(order, {},
                      [&](std::size_t row) { return std::pair{table.time_ns[row], row}; });
    TimedNumbers sorted{.columns = table.columns};
    for (const std::size_t row : order) {
        sorted.time_ns.push_back(table.time_ns[row]);
        const std::span<const double> numbers = table.at(row);
        sorted.numbers.insert(sorted.numbers.end(), numbers.begin(), numbers.end());
    }
    table = std::move(sorted);
}

}  // namespace

std::optional<std::size_t> TimedNumbers::row_until(std::int64_t time) const {
    const auto later = std::ranges::upper_bound(time_ns, time);
    if (later == time_ns.begin()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(later - time_ns.begin()) - 1;
}

std::optional<std::size_t> TimedNumbers::row_near(std::int64_t time, std::int64_t within_ns) const {
    std::optional<std::size_t> nearest;
    std::int64_t least = within_ns;
    const std::size_t first = row_until(time).value_or(0);
    for (std::size_t row = first; row < time_ns.size() && row < first + 2; ++row) {
        const __int128 apart = static_cast<__int128>(time_ns[row]) - time;
        if (apart <= least && -apart <= least) {
            nearest = row;
            least = static_cast<std::int64_t>(apart < 0 ? -apart : apart);
        }
    }
    return nearest;
}

Expected<std::optional<TimedNumbers>> read_companion(const TraceFile& trace, std::string_view name,
                                                     std::string_view time_column_ns,
                                                     std::span<const std::string_view> columns,
                                                     const CompanionNotes& note) {
    using None = std::optional<TimedNumbers>;
    std::string file;
    std::ifstream in;
    if (!trace.empty()) {
        in = open_beside(trace, name, file);
    }
    if (trace.empty() || !in.is_open()) {
        return None{};
    }
    Expected<CsvTable> table = CsvTable::open(in, file);
    if (!table) {
        return std::unexpected(table.error());
    }
    std::vector<std::string_view> lacking = table->missing(columns);
    if (!table->has(time_column_ns)) {
        lacking.insert(lacking.begin(), time_column_ns);
    }
    if (!lacking.empty()) {
        note(fmt::format("{}: not read, for want of the column '{}'", name, lacking.front()),
             gaze::TraceFindingKind::NotRead);
        return None{};
    }
    const std::size_t time_column = *table->column(time_column_ns);
    std::vector<std::size_t> places;
    for (const std::string_view column : columns) {
        places.push_back(*table->column(column));
    }
    TimedNumbers numbers{.columns = columns.size()};
    std::uint64_t unreadable = 0;
    std::uint64_t first_line = 0;
    std::vector<double> row(columns.size());
    while (true) {
        const Expected<bool> more = table->next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            break;
        }
        const std::optional<std::int64_t> time = table->whole(time_column);
        bool complete = time.has_value();
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::optional<double> number = table->real(places[i]);
            complete = complete && number.has_value();
            row[i] = number.value_or(0.0);
        }
        if (!complete) {
            first_line = unreadable++ == 0 ? table->line() : first_line;
            continue;
        }
        numbers.time_ns.push_back(*time);
        numbers.numbers.insert(numbers.numbers.end(), row.begin(), row.end());
    }
    if (unreadable > 0) {
        note(fmt::format("{}: {} {} without all numbers left out, the first is line {}", name,
                         unreadable, unreadable == 1 ? "row" : "rows", first_line),
             gaze::TraceFindingKind::Text);
    }
    sort_by_time(numbers);
    return numbers;
}

}  // namespace gazeloop::drivers
