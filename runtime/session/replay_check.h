#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "runtime/frame/frame_observer.h"
#include "runtime/session/cursor.h"

namespace gazeloop::session {

/// Hashes everything that a replay must reproduce into two numbers: every frame's fovea points, bit
/// by bit, and every frame's pixel hash.
class ReplayHash final : public frame::FrameObserver {
  public:
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

    /// "foveae HEX over N frames" and, where pixels were hashed, "pixels HEX over N frames".
    [[nodiscard]] std::string text() const;
    /// The same for programs: numbers of 64 bits as 16 hexadecimal digits; pixels are null where
    /// none were hashed.
    [[nodiscard]] nlohmann::ordered_json json() const;

  private:
    std::uint64_t foveae_ = 0;
    std::uint64_t pixels_ = 0;
    std::uint64_t fovea_frames_ = 0;
    std::uint64_t pixel_frames_ = 0;
};

/// Compares a replay with the recorded frames, which it reads as the replay goes on: fovea points
/// bit by bit, and pixel hashes where both have them. Throws SetupError (BadInput) if a recorded
/// frame cannot be read.
class ReplayCheck final : public frame::FrameObserver {
  public:
    /// `session` must outlive this. Foveae are compared only if nothing stands in their way, and
    /// pictures only if nothing does in both ways: `other_foveae` and `other_pictures` say what
    /// does, empty if nothing.
    ReplayCheck(const OpenSession& session, std::string other_foveae, std::string other_pictures)
        : handed_over_(session),
          finished_(session),
          other_foveae_(std::move(other_foveae)),
          other_pictures_(other_foveae_.empty() ? std::move(other_pictures) : other_foveae_) {}

    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

    [[nodiscard]] bool equal() const;
    [[nodiscard]] std::string text() const;
    /// The same for programs: null is what was not compared.
    [[nodiscard]] nlohmann::ordered_json json() const;

  private:
    FrameCursor handed_over_;  ///< at the frame of on_frame
    FrameCursor finished_;     ///< at that of on_gpu, some frames behind
    std::string other_foveae_;
    std::string other_pictures_;
    std::uint64_t foveae_equal_ = 0;
    std::uint64_t foveae_compared_ = 0;
    std::uint64_t pixels_equal_ = 0;
    std::uint64_t pixels_compared_ = 0;
    std::optional<std::uint64_t> first_difference_;
};

}  // namespace gazeloop::session
