#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::tests {

/// A Perfetto trace, as a reader that goes by the rules of its format takes it. Field numbers are
/// written here once more, so that a wrong one in the writer is seen.
struct PerfettoTrace {
    struct Track {
        std::uint64_t parent = 0;
        std::string name;
        std::string unit;  ///< of a counter; else empty
    };
    /// A slice, or an instant (of no duration, `instant`).
    struct Slice {
        std::string track;  ///< its name
        std::uint64_t track_id = 0;
        std::string name;
        std::int64_t begin_ns = 0;
        std::int64_t end_ns = 0;
        std::size_t depth = 0;
        bool instant = false;
        std::map<std::string, std::string> annotations{};
        std::vector<std::uint64_t> flows{};
        bool ends_flow = false;

        friend void PrintTo(const Slice& slice, std::ostream* out) {
            *out << slice.track << ": " << slice.name << ' ' << slice.begin_ns << " to "
                 << slice.end_ns;
        }
    };
    struct Count {
        std::string track;
        std::int64_t ns = 0;
        double value = 0.0;
    };

    std::map<std::uint64_t, Track> tracks;
    std::vector<Slice> slices;           ///< by begin; of one time in the order of the file
    std::vector<Count> counts;           ///< by time
    std::optional<std::uint64_t> clock;  ///< of the trace and of its packets
    std::optional<std::int64_t> clock_reading_ns;
    std::uint64_t packets = 0;
    std::vector<std::string> faults;  ///< against the rules; one of each kind

    [[nodiscard]] std::vector<Slice> on(std::string_view track) const;
    [[nodiscard]] std::vector<Slice> named(std::string_view name) const;
    [[nodiscard]] std::vector<Count> counted(std::string_view track) const;
    /// The slices of a flow, in their order.
    [[nodiscard]] std::vector<Slice> flow(std::uint64_t id) const;
};

/// What is no protobuf is a fault, too.
PerfettoTrace read_perfetto(std::string_view bytes);

}  // namespace gazeloop::tests
