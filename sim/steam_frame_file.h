#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>

#include "runtime/error.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::sim {

/// What the Steam Frame's eye service publishes of one sample: bytes only, as three public tools
/// read them, for a file of ours or a test.
inline constexpr std::size_t kSteamFrameRecordBytes = 0x81;
using SteamFrameRecord = std::array<std::uint8_t, kSteamFrameRecordBytes>;

struct SteamFrameGaze {
    struct Ray {
        glm::vec3 direction{0.0F};  ///< in the head; zero: the eye is lost
        glm::vec3 variances{0.0F};  ///< of its components; zero: not stated
    };
    double time_s = 0.0;  ///< of CLOCK_MONOTONIC_RAW
    gaze::PerEye<Ray> filtered{};
    gaze::PerEye<Ray> before_fusion{};
    glm::vec3 fixation_m{0.0F};
    gaze::PerEye<float> openness{};
};

[[nodiscard]] SteamFrameRecord steam_frame_record(const SteamFrameGaze& gaze);

/// Of a sample that was taken at `raw_ns`. Each eye's own direction is the sample's. The filtered
/// one is turned half-way to the mean of both eyes' and keeps half of its variance: a stand-in for
/// a fusion that nobody has described. An eye that is not valid is lost in both. Both look at the
/// point `distance_m` ahead along their mean.
[[nodiscard]] SteamFrameGaze steam_frame_gaze(const gaze::GazeSample& sample, std::int64_t raw_ns,
                                              double distance_m = 1.5);

/// In which order a service stores a sample, which nobody has said of the real one.
enum class StoreOrder : std::uint8_t { CounterLast, CounterFirst };

/// A file as the service writes it, which other processes read meanwhile. The destructor removes
/// it. Errors (BadInput) of all that stores: somebody has cut the file short, or it cannot be
/// written.
class SteamFrameFile {
  public:
    /// Versions 4 and 5 are as the tools know them; another one is laid out as 5. Errors
    /// (BadInput): there is one already, or it cannot be made.
    [[nodiscard]] static Expected<SteamFrameFile> create(const std::filesystem::path& path,
                                                         std::uint32_t version = 5,
                                                         bool initialised = true);
    SteamFrameFile(SteamFrameFile&& other) noexcept;
    SteamFrameFile(const SteamFrameFile&) = delete;
    SteamFrameFile& operator=(SteamFrameFile&&) = delete;
    SteamFrameFile& operator=(const SteamFrameFile&) = delete;
    ~SteamFrameFile();

    /// Counts up by 1 + `skipped` and stores the sample.
    [[nodiscard]] Expected<void> publish(const SteamFrameRecord& record,
                                         StoreOrder order = StoreOrder::CounterLast,
                                         std::uint32_t skipped = 0);

    /// Whether readers may take it for ready.
    Expected<void> set_initialised(bool initialised);

    [[nodiscard]] std::uint32_t counter() const { return counter_; }

  private:
    SteamFrameFile(std::filesystem::path path, int fd, std::uint32_t version);
    Expected<void> store(std::size_t at, std::span<const std::uint8_t> bytes);

    std::filesystem::path path_;
    int fd_;
    std::size_t record_at_;
    std::uint32_t counter_ = 0;
};

}  // namespace gazeloop::sim
