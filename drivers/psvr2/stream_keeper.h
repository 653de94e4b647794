#pragma once

#include <algorithm>
#include <cstdint>

namespace gazeloop::drivers::psvr2 {

/// When the headset has to be asked for gaze: at first, then every second, and whenever 500 ms have
/// passed without data. A change of its display or of see-through ends the stream.
class StreamKeeper {
  public:
    static constexpr std::int64_t kKeepAlive_ns = 1'000'000'000;
    static constexpr std::int64_t kSilence_ns = 500'000'000;

    explicit StreamKeeper(std::int64_t now_ns)
        : asked_ns_(now_ns - kKeepAlive_ns), heard_ns_(now_ns) {}

    /// When it is next to be asked, if nothing comes until then.
    [[nodiscard]] std::int64_t next_ns() const {
        // Silence counts only from the last request on.
        const std::int64_t silent_ns = std::max(heard_ns_, asked_ns_) + kSilence_ns;
        return std::min(asked_ns_ + kKeepAlive_ns, silent_ns);
    }

    void asked(std::int64_t now_ns) { asked_ns_ = now_ns; }
    void heard(std::int64_t now_ns) { heard_ns_ = now_ns; }

    [[nodiscard]] bool silent(std::int64_t now_ns) const {
        return now_ns - heard_ns_ >= kSilence_ns;
    }

  private:
    std::int64_t asked_ns_;
    std::int64_t heard_ns_;
};

}  // namespace gazeloop::drivers::psvr2
