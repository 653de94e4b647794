#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/frame/frame_observer.h"
#include "runtime/preview/preview_memory.h"
#include "runtime/render/frame_view.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::preview {

/// Copies of the loop's pictures for a preview. The loop's thread only records and submits a copy,
/// and only when the window has asked for a picture and the last copy is out. The feed's own thread
/// waits for the GPU and hands the picture over. Frames that meet a busy window are counted and
/// dropped. The frames themselves are not touched. A frame that nobody draws is black, as it is on
/// the display: the window must not go on showing the one before.
class PreviewFeed final : public frame::FrameObserver {
  public:
    struct Options {
        gaze::PerEye<vk::Extent2D> extents;
        vk::Format format = vk::Format::eUndefined;  ///< 8 bits per channel
        DisplayTimes display;
        frame::PassList passes;  ///< of the run
        /// Radius of the fovea's ring in the frame that was rendered last; 0: none is known.
        std::function<double(gaze::Eye)> ring_radius_px;
    };
    PreviewFeed(const vulkan::Context& context, const Options& options, PreviewMemory& memory);
    PreviewFeed(const PreviewFeed&) = delete;
    PreviewFeed& operator=(const PreviewFeed&) = delete;
    ~PreviewFeed() override;

    void on_rendered(const render::FrameView& view, const gaze::FrameFovea& fovea) override;
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

    /// Drawn or black.
    [[nodiscard]] std::uint64_t frames_shown() const { return copies_; }
    [[nodiscard]] std::uint64_t frames_dropped() const { return dropped_; }

  private:
    struct EyeCopy {
        vulkan::ColorImage reduced;
        vulkan::HostBuffer pixels;
    };

    /// Whether the window has taken the last picture and asks for one more.
    [[nodiscard]] bool wanted() const;
    /// Null for the fovea: the frame is black, and has none.
    void describe(std::uint64_t frame, const gaze::FrameFovea* fovea, std::uint32_t eyes);
    void show_black(std::uint64_t frame);
    void submitted();
    void record_copy(const render::FrameView& view, std::uint32_t eyes);
    void hand_over(const std::stop_token& stop);

    const vulkan::Context* context_;
    Options options_;
    PreviewMemory* memory_;
    std::uint32_t reduction_ = 1;
    gaze::PerEye<EyeCopy> eyes_;
    vk::raii::CommandPool pool_{nullptr};
    vk::raii::CommandBuffer commands_{nullptr};
    vk::raii::Semaphore copied_{nullptr};
    std::uint64_t copies_ = 0;  ///< submitted, or black; the timeline's value
    std::uint64_t dropped_ = 0;
    PreviewFrame next_;
    bool black_ = false;                        ///< `next_` is black
    std::array<frame::FrameRecord, 4> frames_;  ///< by index; the GPU is at most 3 behind
    StageBars bars_;
    std::atomic<std::uint64_t> known_{0};  ///< `copies_`, as the thread sees them
    std::jthread thread_;
};

}  // namespace gazeloop::preview
