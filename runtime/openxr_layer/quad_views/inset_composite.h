#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "runtime/gaze/eye.h"
#include "runtime/openxr_layer/quad_views/inset.h"
#include "runtime/openxr_layer/quad_views/vulkan_functions.h"

namespace gazeloop::openxr_layer {

/// An application's device, as it gives it to the runtime.
struct ApplicationDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    std::uint32_t queue_index = 0;
};

/// A picture of the application's: a rectangle of one layer of an image.
struct GivenPicture {
    VkImage image = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t array_layer = 0;
    PictureSize texture;
    VkRect2D rect{};
};

/// What is drawn for one eye.
struct CompositedEye {
    GivenPicture outer;
    GivenPicture inset;
    PicturePart covers;  ///< what of the outer picture's field the inset covers
    VkImage target = VK_NULL_HANDLE;
};

/// Lays insets over the pictures around them, on an application's own device and queue. Images are
/// found and left in COLOR_ATTACHMENT_OPTIMAL, as OpenXR has them. Whoever calls must be allowed to
/// use the queue: in a call of OpenXR that may. Failures of Vulkan throw std::runtime_error.
class InsetComposite {
  public:
    /// Errors: as VulkanFunctions::of().
    static Expected<std::unique_ptr<InsetComposite>> create(const ApplicationDevice& device);
    InsetComposite(const InsetComposite&) = delete;
    InsetComposite& operator=(const InsetComposite&) = delete;
    ~InsetComposite();

    /// One submit. `blend`: as InsetPolicy. Targets have this size and format. Waits for the GPU
    /// only where it is kFrames behind. No memory is allocated once every image has been seen.
    void draw(const gaze::PerEye<CompositedEye>& eyes, const PictureSize& size, VkFormat format,
              double blend);

    /// How long the GPU took for a frame's composite that it has finished, and how many were drawn
    /// before that one; each is told once. None: no other is finished, or the queue has no clock.
    struct Timed {
        std::uint64_t number = 0;
        std::int64_t ns = 0;
    };
    [[nodiscard]] std::optional<Timed> take_timed();

    /// The image is about to be destroyed.
    void forget(VkImage image);

  private:
    static constexpr std::size_t kFrames = 3;

    /// What a frame uses until the GPU has finished it.
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
        gaze::PerEye<VkDescriptorSet> sets{};
        std::optional<std::uint64_t> under_way;  ///< the number of its frame
    };

    InsetComposite(const ApplicationDevice& device, const VulkanFunctions& vk);
    void make_layout();
    void make_slots();
    void make_uniforms();
    void finish(Slot& slot);
    void wait_for_all();
    [[nodiscard]] VkImageView view_of(VkImage image, VkFormat format, std::uint32_t layer);
    [[nodiscard]] VkRenderPass pass_of(VkFormat format);
    [[nodiscard]] VkPipeline pipeline_of(VkFormat format);
    [[nodiscard]] VkFramebuffer framebuffer_of(VkImage image, VkFormat format,
                                               const PictureSize& size);
    void bind(std::size_t slot, std::size_t eye, const CompositedEye& composited,
              const PictureSize& size, double blend);
    void record(std::size_t slot, const gaze::PerEye<CompositedEye>& eyes, const PictureSize& size,
                VkFormat format);
    [[nodiscard]] VkShaderModule shader(const std::uint32_t* words, std::size_t bytes);

    ApplicationDevice device_;
    VulkanFunctions vk_;
    VkQueue queue_ = VK_NULL_HANDLE;
    double timestamp_ns_ = 0.0;  ///< of one tick; 0: the queue has no clock
    std::uint64_t timestamp_mask_ = 0;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    VkBuffer uniforms_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    std::array<Slot, kFrames> slots_;
    std::uint64_t drawn_ = 0;
    std::array<std::optional<Timed>, kFrames> timed_;

    std::map<std::tuple<VkImage, VkFormat, std::uint32_t>, VkImageView> views_;
    std::map<VkFormat, VkRenderPass> passes_;
    std::map<VkFormat, VkPipeline> pipelines_;
    std::map<VkImage, VkFramebuffer> framebuffers_;
    std::vector<std::function<void()>> undo_;  ///< from the last to the first
};

}  // namespace gazeloop::openxr_layer
