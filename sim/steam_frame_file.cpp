#include "sim/steam_frame_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <glm/geometric.hpp>
#include <span>
#include <system_error>
#include <utility>

#include "runtime/gaze/direction.h"

namespace gazeloop::sim {
namespace {

constexpr std::size_t kFileBytes = 4096;  // assumed: one page
constexpr std::size_t kInitialisedAt = 0x04;
constexpr std::size_t kCounterAt = 0x38;
constexpr std::size_t kRecordOfVersion4At = 0x152;
constexpr std::size_t kRecordAt = 0x157;

/// Writes one thing after the other, little-endian.
class Bytes {
  public:
    Bytes(std::span<std::uint8_t> bytes, std::size_t at) : bytes_(bytes), at_(at) {}

    template <typename Unsigned>
    void add(Unsigned value) {
        for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
            bytes_[at_++] = static_cast<std::uint8_t>(value >> (8U * i));
        }
    }
    void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
    void add(const glm::vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(const gaze::PerEye<SteamFrameGaze::Ray>& rays) {
        add(rays[0].direction);
        add(rays[1].direction);
        add(rays[0].variances);
        add(rays[1].variances);
    }

  private:
    std::span<std::uint8_t> bytes_;
    std::size_t at_;
};

/// Variances along X, Y and Z of an error that is alike on all axes.
glm::vec3 variances_of(const gaze::EyeRay& ray) {
    if (!ray.covariance) {
        return glm::vec3{0.0F};
    }
    return glm::vec3{static_cast<float>(0.5 * (ray.covariance->xx_rad2 + ray.covariance->yy_rad2))};
}

}  // namespace

SteamFrameRecord steam_frame_record(const SteamFrameGaze& gaze) {
    SteamFrameRecord record{};
    constexpr std::size_t kTimeAt = 0x05;
    Bytes bytes(record, kTimeAt);
    bytes.add(std::bit_cast<std::uint64_t>(gaze.time_s));
    bytes.add(gaze.filtered);
    bytes.add(gaze.fixation_m);
    bytes.add(gaze.before_fusion);
    bytes.add(gaze.openness[0]);
    bytes.add(gaze.openness[1]);
    return record;
}

SteamFrameGaze steam_frame_gaze(const gaze::GazeSample& sample, std::int64_t raw_ns,
                                double distance_m) {
    SteamFrameGaze gaze;
    gaze.time_s = static_cast<double>(raw_ns) * 1e-9;
    glm::dvec3 sum{0.0};
    for (const gaze::EyeRay& ray : sample.eyes) {
        sum += ray.valid ? ray.direction : glm::dvec3{0.0};
    }
    const glm::dvec3 mean = gaze::unit(sum).value_or(gaze::kStraightAhead);
    gaze.fixation_m = distance_m * mean;
    for (const gaze::Eye eye : gaze::kEyes) {
        const gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        gaze.openness[gaze::index(eye)] = static_cast<float>(std::max(ray.openness, 0.0));
        if (ray.valid) {
            gaze.before_fusion[gaze::index(eye)] = {ray.direction, variances_of(ray)};
            gaze.filtered[gaze::index(eye)] = {gaze::interpolate(ray.direction, mean, 0.5),
                                               0.5F * variances_of(ray)};
        }
    }
    return gaze;
}

Expected<SteamFrameFile> SteamFrameFile::create(const std::filesystem::path& path,
                                                std::uint32_t version, bool initialised) {
    const auto failed = [&path](std::string_view what) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: {}: {}", path.string(), what,
                                                   std::generic_category().message(errno))});
    };
    const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd < 0) {
        return failed(errno == EEXIST
                          ? "is there already, a headset's or that of a simulation that "
                            "was killed: name another file, or remove it"
                          : "cannot be made");
    }
    // Not ftruncate(), which reserves nothing: a later write to a full disk would then fail.
    SteamFrameFile file(path, fd, version);
    if (const int error = posix_fallocate(fd, 0, kFileBytes); error != 0) {
        errno = error;
        return failed("cannot be made: free space there, or name another file");
    }
    std::array<std::uint8_t, sizeof version> bytes{};
    Bytes(bytes, 0).add(version);
    if (auto stored = file.store(0, bytes); !stored) {
        return std::unexpected(std::move(stored.error()));
    }
    if (auto stored = file.set_initialised(initialised); !stored) {
        return std::unexpected(std::move(stored.error()));
    }
    return file;
}

SteamFrameFile::SteamFrameFile(std::filesystem::path path, int fd, std::uint32_t version)
    : path_(std::move(path)), fd_(fd), record_at_(version == 4 ? kRecordOfVersion4At : kRecordAt) {}

SteamFrameFile::SteamFrameFile(SteamFrameFile&& other) noexcept
    : path_(std::move(other.path_)),
      fd_(std::exchange(other.fd_, -1)),
      record_at_(other.record_at_),
      counter_(other.counter_) {}

SteamFrameFile::~SteamFrameFile() {
    if (fd_ < 0) {
        return;
    }
    struct stat ours{};
    struct stat there{};
    // What somebody else has put in its place stays.
    if (fstat(fd_, &ours) == 0 && lstat(path_.c_str(), &there) == 0 &&
        ours.st_dev == there.st_dev && ours.st_ino == there.st_ino) {
        unlink(path_.c_str());
    }
    close(fd_);
}

Expected<void> SteamFrameFile::publish(const SteamFrameRecord& record, StoreOrder order,
                                       std::uint32_t skipped) {
    counter_ += 1 + skipped;
    std::array<std::uint8_t, sizeof counter_> counter{};
    Bytes(counter, 0).add(counter_);
    const bool counter_first = order == StoreOrder::CounterFirst;
    const auto first = counter_first ? store(kCounterAt, counter) : store(record_at_, record);
    if (!first) {
        return first;
    }
    return counter_first ? store(record_at_, record) : store(kCounterAt, counter);
}

Expected<void> SteamFrameFile::set_initialised(bool initialised) {
    std::array<std::uint8_t, sizeof(std::uint32_t)> bytes{};
    Bytes(bytes, 0).add(std::uint32_t{initialised ? 1U : 0U});
    return store(kInitialisedAt, bytes);
}

Expected<void> SteamFrameFile::store(std::size_t at, std::span<const std::uint8_t> bytes) {
    // Not through mapped memory: a file that somebody cuts short would then be a signal.
    struct stat status{};
    if (fstat(fd_, &status) == 0 && status.st_size < static_cast<off_t>(kFileBytes)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: another program has cut it to {} bytes: nothing more can be "
                              "published; start again",
                              path_.string(), status.st_size)});
    }
    if (pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at)) !=
        static_cast<ssize_t>(bytes.size())) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: cannot be written ({})", path_.string(),
                                                   std::generic_category().message(errno))});
    }
    return {};
}

}  // namespace gazeloop::sim
