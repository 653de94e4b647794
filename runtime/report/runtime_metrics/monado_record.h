#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace gazeloop::report {

// What Monado writes of its frames to the file that XRT_METRICS_FILE names, as far as it is used
// here (Monado 25.0.0, monado_metrics.proto, version 1.1). An application's frame ("session frame")
// and a frame of the compositor ("system frame") are numbered apart. Times are nanoseconds of
// CLOCK_MONOTONIC; 0: not told, or beyond 63 bits.

/// The file's first record.
struct MonadoVersion {
    std::uint32_t major = 0;
    std::uint32_t minor = 0;
};

/// An application's frame, written when its GPU work is done or when it is discarded.
struct MonadoSessionFrame {
    std::int64_t session = 0;
    std::int64_t frame = 0;
    std::int64_t predicted_display_ns = 0;  ///< as the application was told
    std::int64_t begin_ns = 0;
    std::int64_t gpu_done_ns = 0;
    bool discarded = false;
};

/// A system frame takes a session frame, once for each time that it shows it.
struct MonadoUsed {
    std::int64_t session = 0;
    std::int64_t session_frame = 0;
    std::int64_t system_frame = 0;
    std::int64_t when_ns = 0;
};

/// A system frame is planned: written alone where the compositor has no display timing and paces
/// itself by a model of a display ("fake pacing").
struct MonadoSystemFrame {
    std::int64_t frame = 0;
    std::int64_t predicted_display_ns = 0;
    std::int64_t desired_present_ns = 0;
};

/// The compositor's own GPU work for a system frame.
struct MonadoGpuInfo {
    std::int64_t frame = 0;
    std::int64_t gpu_end_ns = 0;
    std::int64_t when_ns = 0;
};

/// What the display's driver said of a system frame afterwards (VK_GOOGLE_display_timing).
struct MonadoPresentInfo {
    std::int64_t frame = 0;
    std::int64_t predicted_display_ns = 0;
    std::int64_t desired_present_ns = 0;
    std::int64_t actual_present_ns = 0;  ///< the scan-out of its picture began
    std::int64_t when_ns = 0;            ///< Monado was told
};

/// std::monostate: of no kind that is used here.
using MonadoRecord = std::variant<std::monostate, MonadoVersion, MonadoSessionFrame, MonadoUsed,
                                  MonadoSystemFrame, MonadoGpuInfo, MonadoPresentInfo>;

/// One record without its length. Unknown fields are skipped. None: the bytes are no protobuf
/// message, or a field is of another type.
[[nodiscard]] std::optional<MonadoRecord> monado_record(std::string_view bytes);

}  // namespace gazeloop::report
