#pragma once

#include <vector>

#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/pass_recorder.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::bench {

/// A plain bilinear enlargement of a picture by the driver's own blit: what a pass costs at the
/// least that makes a whole picture of an LP-buffer.
class PlainBlit {
  public:
    /// From an image of linear light as LP-buffers are to a picture of this size and format.
    PlainBlit(const vulkan::Context& context, vk::Extent2D from, vk::Extent2D to,
              vk::Format format);

    /// Does it once, and keeps what it took unless it is the first, which compiles.
    void round(bool keep = true);
    /// Precondition: a round was kept.
    [[nodiscard]] double median_ms() const;

  private:
    const vulkan::Context* context_;
    frame::PassList passes_{"blit"};
    vulkan::PassRecorder recorder_;
    vulkan::GpuClock clock_;
    vulkan::ColorImage from_;
    vulkan::ColorImage to_;
    vulkan::TrackedImage from_use_;
    vulkan::TrackedImage to_use_;
    vk::raii::Semaphore done_;
    std::uint64_t rounds_ = 0;
    std::vector<double> ms_;
};

}  // namespace gazeloop::bench
