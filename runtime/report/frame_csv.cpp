#include "runtime/report/frame_csv.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

namespace gazeloop::report {
namespace {

constexpr std::size_t kPieceBytes = 1 << 20;
constexpr std::size_t kMillion = 1'000'000;
constexpr std::size_t kDecimals = 6;

template <typename Integer>
void append(std::string& text, Integer number) {
    std::array<char, std::numeric_limits<Integer>::digits10 + 3> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), end);
}

/// A number of millionths, exactly.
void append_millionths(std::string& text, std::int64_t millionths) {
    const auto bits = static_cast<std::uint64_t>(millionths);
    const std::uint64_t magnitude = millionths < 0 ? 0 - bits : bits;
    text += millionths < 0 ? "-" : "";
    append(text, magnitude / kMillion);
    std::array<char, kDecimals + 1> decimals{'.', '0', '0', '0', '0', '0', '0'};
    std::uint64_t rest = magnitude % kMillion;
    for (std::size_t place = kDecimals; rest > 0; --place, rest /= 10) {
        decimals[place] = static_cast<char>('0' + rest % 10);
    }
    text.append(decimals.data(), decimals.size());
}

void append_cell(std::string& text, const DurationColumn& column, std::size_t row) {
    text += ',';
    if (const std::optional<std::int64_t> number = column.at(row)) {
        if (column.unit() == Unit::Count) {
            append(text, *number);
        } else {
            append_millionths(text, *number);
        }
    }
}

void append_time(std::string& text, const std::optional<std::int64_t>& ns) {
    text += ',';
    if (ns) {
        append(text, *ns);
    }
}

}  // namespace

Expected<void> write_frame_csv(const FrameLog& frames,
                               const std::function<Expected<void>(std::string_view)>& write) {
    std::string text = "frame,wake_up_ns,shown_ns,gaze_state,eye_event";
    for (const DurationColumn& column : frames.columns()) {
        text += ',' + column.key();
        text += unit_suffix(column.unit());
    }
    text += '\n';
    for (std::size_t row = 0; row < frames.rows(); ++row) {
        append(text, frames.number(row));
        append_time(text, frames.wake_up_ns(row));
        append_time(text, frames.shown_ns(row));
        text += ',';
        if (const auto state = frames.state(row)) {
            text += gaze::kFoveaStateNames[static_cast<std::size_t>(*state)];
        }
        text += ',';
        if (const auto event = frames.eye_event(row)) {
            text += gaze::name(*event);
        }
        for (const DurationColumn& column : frames.columns()) {
            append_cell(text, column, row);
        }
        text += '\n';
        if (text.size() >= kPieceBytes) {
            if (auto written = write(text); !written) {
                return written;
            }
            text.clear();
        }
    }
    return write(text);
}

}  // namespace gazeloop::report
