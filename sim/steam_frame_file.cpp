#include "sim/steam_frame_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
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
    void* memory = MAP_FAILED;
    // Not ftruncate(), which reserves nothing: a write to a full disk would then be a signal.
    int error = posix_fallocate(fd, 0, kFileBytes);
    if (error == 0) {
        memory = mmap(nullptr, kFileBytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
        error = errno;
    }
    close(fd);
    if (memory == MAP_FAILED) {
        unlink(path.c_str());
        errno = error;
        return failed("cannot be made and mapped: free space there, or name another file");
    }
    SteamFrameFile file(path, static_cast<std::uint8_t*>(memory), version);
    file.set_initialised(initialised);
    return file;
}

SteamFrameFile::SteamFrameFile(std::filesystem::path path, std::uint8_t* memory,
                               std::uint32_t version)
    : path_(std::move(path)),
      memory_(memory),
      record_at_(version == 4 ? kRecordOfVersion4At : kRecordAt) {
    Bytes({memory_, kFileBytes}, 0).add(version);
}

SteamFrameFile::SteamFrameFile(SteamFrameFile&& other) noexcept
    : path_(std::move(other.path_)),
      memory_(std::exchange(other.memory_, nullptr)),
      record_at_(other.record_at_),
      counter_(other.counter_) {}

SteamFrameFile::~SteamFrameFile() {
    if (memory_ != nullptr) {
        munmap(memory_, kFileBytes);
        unlink(path_.c_str());
    }
}

void SteamFrameFile::publish(const SteamFrameRecord& record, StoreOrder order,
                             std::uint32_t skipped) {
    counter_ += 1 + skipped;
    if (order == StoreOrder::CounterFirst) {
        store_counter();
    }
    std::ranges::copy(record, memory_ + record_at_);
    std::atomic_signal_fence(std::memory_order_seq_cst);  // in this order, for other processes too
    if (order == StoreOrder::CounterLast) {
        store_counter();
    }
}

void SteamFrameFile::store_counter() {
    std::atomic_ref(*reinterpret_cast<std::uint32_t*>(memory_ + kCounterAt))
        .store(counter_, std::memory_order_seq_cst);
}

void SteamFrameFile::set_initialised(bool initialised) {
    Bytes({memory_, kFileBytes}, kInitialisedAt).add(std::uint32_t{initialised ? 1U : 0U});
}

}  // namespace gazeloop::sim
