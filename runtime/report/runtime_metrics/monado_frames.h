#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "runtime/report/runtime_metrics/monado_metrics_reader.h"
#include "runtime/time/stamp.h"

namespace gazeloop::report {

/// What Monado says became of an application's frame.
enum class MonadoFate : std::uint8_t {
    Presented,  ///< shown, and the display's driver told when
    Modelled,   ///< shown, when the model of a display says by which the compositor paces itself
    Replaced,   ///< never shown: a later frame was taken first
    Missing,    ///< the file has no frame of this display time
    Discarded,  ///< the application gave it up, as the runtime saw it
    NotTaken,   ///< the file does not say that the compositor took it
    Untimed,    ///< taken, but the file does not say when it was shown, or says what cannot be
};
inline constexpr std::size_t kMonadoFateCount = 7;

struct MonadoShown {
    MonadoFate fate = MonadoFate::Missing;
    time::Stamp present{};    ///< the scan-out of the compositor's picture began
    time::Stamp shown{};      ///< the middle of its emission: Monado's own constant after that
    std::uint64_t times = 0;  ///< that the compositor took it; above 1 where no later one was there
    /// The compositor's own GPU work for it ended after its present, so that a modelled one is
    /// too early.
    bool compositor_late = false;
};

/// The frames of a metrics file near a time that goes on. Of the file as much is read as is needed,
/// in its order; memory is bounded.
class MonadoFrames {
  public:
    /// So many frames of applications, and of the compositor, are kept.
    static constexpr std::size_t kKept = 4096;

    explicit MonadoFrames(MonadoMetricsReader file);

    /// Reads on until the file's records are from after this time (host time), which never goes
    /// back by much. A few absurd times among them change nothing.
    void read_until(std::int64_t until_ns);

    /// The fate of the frame that was announced to be displayed at `display_ns`. Where several
    /// applications had the same display time, it is the one whose begin is nearest to `begin_ns`.
    [[nodiscard]] MonadoShown find(std::int64_t display_ns, std::int64_t begin_ns) const;

    [[nodiscard]] const MonadoMetricsReader& file() const { return file_; }
    /// The times of the first and the last record so far that has one.
    [[nodiscard]] std::optional<std::int64_t> first_ns() const { return first_ns_; }
    [[nodiscard]] std::optional<std::int64_t> last_ns() const { return last_ns_; }

  private:
    struct AppFrame {
        std::int64_t session = 0;
        std::int64_t frame = 0;
        std::int64_t display_ns = 0;
        std::int64_t begin_ns = 0;
        bool discarded = false;
        std::int64_t system_frame = 0;  ///< that took it first; meaningful if times is not 0
        std::uint64_t times = 0;
    };
    struct SystemFrame {
        std::int64_t frame = -1;
        std::int64_t predicted_display_ns = 0;
        std::int64_t desired_present_ns = 0;
        std::int64_t actual_present_ns = 0;  ///< 0: not told
        std::int64_t gpu_end_ns = 0;         ///< 0: not told
    };
    struct AppFrameId {
        std::int64_t session;
        std::int64_t frame;
        friend bool operator==(const AppFrameId&, const AppFrameId&) = default;
    };
    struct HashOfId {
        std::size_t operator()(const AppFrameId& id) const;
    };

    /// The time of the record, where it has one.
    std::int64_t take(const MonadoRecord& record);
    void take(const MonadoSessionFrame& frame);
    void take(const MonadoUsed& used);
    [[nodiscard]] SystemFrame* system_frame(std::int64_t frame);
    [[nodiscard]] MonadoShown shown(const AppFrame& frame) const;
    /// Whether the compositor took a frame that the application made later.
    [[nodiscard]] bool later_one_taken(std::size_t place) const;

    MonadoMetricsReader file_;
    bool at_end_ = false;
    std::optional<std::int64_t> first_ns_;
    std::optional<std::int64_t> last_ns_;
    std::vector<AppFrame> frames_;  ///< a ring, once it is full
    std::size_t oldest_ = 0;
    std::unordered_multimap<std::int64_t, std::size_t> by_display_;
    std::unordered_map<AppFrameId, std::size_t, HashOfId> by_id_;
    std::vector<SystemFrame> system_frames_;  ///< by number modulo size
};

}  // namespace gazeloop::report
