#include "runtime/session/replay_check.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <nlohmann/json.hpp>

namespace gazeloop::session {
namespace {

/// The bits of a frame's foveae that the picture depends on.
using FoveaBits = std::array<std::uint64_t, 7 * gaze::kEyeCount>;

FoveaBits bits(const gaze::FrameFovea& fovea) {
    FoveaBits all{};
    std::size_t i = 0;
    for (const gaze::FoveaPoint& point : fovea.eyes) {
        for (const double value : {point.position.x_px, point.position.y_px, point.direction.x,
                                   point.direction.y, point.direction.z}) {
            all[i++] = std::bit_cast<std::uint64_t>(value);
        }
        all[i++] = static_cast<std::uint64_t>(point.state);
        all[i++] = point.sample_sequence;
    }
    return all;
}

nlohmann::ordered_json hash_json(std::uint64_t hash, std::uint64_t frames) {
    return {{"hash", fmt::format("{:016x}", hash)}, {"frames", frames}};
}

nlohmann::ordered_json comparison_json(std::uint64_t equal, std::uint64_t compared) {
    return {{"equal", equal}, {"of", compared}};
}

std::uint64_t fold(std::uint64_t seed, const void* data, std::size_t bytes) {
    return XXH3_64bits_withSeed(data, bytes, seed);
}

}  // namespace

void ReplayHash::on_frame(const frame::FrameRecord& record) {
    const FoveaBits fovea = bits(record.fovea);
    foveae_ = fold(foveae_, fovea.data(), sizeof fovea);
    ++fovea_frames_;
}

void ReplayHash::on_gpu(const frame::FrameGpuRecord& record) {
    if (record.pixel_hash) {
        pixels_ = fold(pixels_, &*record.pixel_hash, sizeof *record.pixel_hash);
        ++pixel_frames_;
    }
}

std::string ReplayHash::text() const {
    std::string text = fmt::format("hash foveae {:016x} over {} frames\n", foveae_, fovea_frames_);
    if (pixel_frames_ > 0) {
        text += fmt::format("hash pixels {:016x} over {} frames\n", pixels_, pixel_frames_);
    }
    return text;
}

nlohmann::ordered_json ReplayHash::json() const {
    return {{"foveae", hash_json(foveae_, fovea_frames_)},
            {"pixels", pixel_frames_ > 0 ? hash_json(pixels_, pixel_frames_)
                                         : nlohmann::ordered_json(nullptr)}};
}

void ReplayCheck::on_frame(const frame::FrameRecord& record) {
    if (!other_foveae_.empty() || !value_or_throw(move_to(handed_over_, record.index))) {
        return;
    }
    ++foveae_compared_;
    if (bits(record.fovea) == bits(handed_over_.row()->frame.fovea)) {
        ++foveae_equal_;
    } else if (!first_difference_) {
        first_difference_ = record.index;
    }
}

void ReplayCheck::on_gpu(const frame::FrameGpuRecord& record) {
    if (!other_pictures_.empty() || !value_or_throw(move_to(finished_, record.index))) {
        return;
    }
    const auto& recorded = finished_.row()->gpu.pixel_hash;
    if (!record.pixel_hash || !recorded) {
        return;
    }
    ++pixels_compared_;
    if (*record.pixel_hash == *recorded) {
        ++pixels_equal_;
    } else {
        first_difference_ = std::min(first_difference_.value_or(record.index), record.index);
    }
}

bool ReplayCheck::equal() const {
    return foveae_equal_ == foveae_compared_ && pixels_equal_ == pixels_compared_;
}

std::string ReplayCheck::text() const {
    std::string text = other_foveae_.empty()
                           ? fmt::format("replay: foveae bit-equal in {} of {} frames\n",
                                         foveae_equal_, foveae_compared_)
                           : fmt::format("replay: foveae not compared: {}\n", other_foveae_);
    if (pixels_compared_ > 0) {
        text += fmt::format("replay: pictures equal in {} of {} frames\n", pixels_equal_,
                            pixels_compared_);
    } else {
        text += fmt::format(
            "replay: pictures not compared: {}\n",
            other_pictures_.empty() ? "not hashed in both runs (--hash)" : other_pictures_);
    }
    if (first_difference_) {
        text += fmt::format("replay: first difference in frame {}\n", *first_difference_);
    }
    return text;
}

nlohmann::ordered_json ReplayCheck::json() const {
    const nlohmann::ordered_json none(nullptr);
    return {
        {"foveae", other_foveae_.empty() ? comparison_json(foveae_equal_, foveae_compared_) : none},
        {"pixels", pixels_compared_ > 0 ? comparison_json(pixels_equal_, pixels_compared_) : none},
        {"first_difference",
         first_difference_ ? nlohmann::ordered_json(*first_difference_) : none}};
}

}  // namespace gazeloop::session
