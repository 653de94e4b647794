#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"
#include "runtime/vulkan/layered_image.h"

namespace gazeloop::vulkan {

/// Fills layers of images in the order of the queue: what is submitted later sees them, and nobody
/// waits but who writes into the buffer again that they came from.
class LayerUploads {
  public:
    explicit LayerUploads(const Context& context);
    LayerUploads(const LayerUploads&) = delete;
    LayerUploads& operator=(const LayerUploads&) = delete;
    /// Waits for all.
    ~LayerUploads();

    /// Submits replace_layers(); returns the upload's number, which is that of the one before and
    /// one more. The image and the buffer must stay until it is done.
    std::uint64_t submit(const LayeredImage& image, vk::Buffer from,
                         std::span<const LayerSource> layers);
    /// Whether the device has finished an upload, and with it all before; 0 is none.
    [[nodiscard]] bool is_done(std::uint64_t upload) const;
    void wait(std::uint64_t upload) const;

  private:
    struct Commands {
        vk::raii::CommandBuffer buffer;
        std::uint64_t upload = 0;  ///< that they were last
    };
    [[nodiscard]] Commands& free_commands();

    const Context& context_;
    vk::raii::CommandPool pool_;
    vk::raii::Semaphore done_{nullptr};  ///< uploads finished
    std::vector<Commands> commands_;     ///< as many as were under way at a time
    std::uint64_t submitted_ = 0;
};

}  // namespace gazeloop::vulkan
