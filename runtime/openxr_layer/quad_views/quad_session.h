#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "runtime/openxr_layer/next_functions.h"
#include "runtime/openxr_layer/quad_views/inset_composite.h"
#include "runtime/openxr_layer/quad_views/quad_sizes.h"

namespace gazeloop::openxr_layer {

/// The swapchains and frames of a session whose application may draw four views, of which the
/// runtime gets two. Calls may come from several threads.
///
/// An image that the application releases stays acquired below until its frame has ended or the
/// swapchain is acquired again, so that the runtime does not take it while it is read.
class QuadSession {
  public:
    QuadSession(const NextFunctions& next, XrSession session, const ApplicationDevice& device,
                const QuadSizes& sizes, const InsetPolicy& policy)
        : next_(next), session_(session), device_(device), sizes_(sizes), policy_(policy) {}
    QuadSession(const QuadSession&) = delete;
    QuadSession& operator=(const QuadSession&) = delete;
    ~QuadSession();

    [[nodiscard]] const QuadSizes& sizes() const { return sizes_; }
    /// Whether the session was begun with four views.
    void begin(bool with_four_views);
    [[nodiscard]] bool has_four_views() const;

    void add(XrSwapchain swapchain, const XrSwapchainCreateInfo& info);
    void remove(XrSwapchain swapchain);
    XrResult acquire(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info,
                     std::uint32_t* index);
    XrResult wait(XrSwapchain swapchain, const XrSwapchainImageWaitInfo* info);
    XrResult release(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo* info);

    /// Ends the frame below with two views for four. Where they cannot be composited, which is said
    /// once, the outer views are shown alone. `frame`: the number of the frame where it is
    /// recorded.
    XrResult end_frame(const XrFrameEndInfo& info, std::optional<std::uint64_t> frame);

    /// What the GPU took for composites that it has finished since the last call, one at a time.
    struct Timed {
        std::uint64_t frame = 0;
        std::int64_t ns = 0;
    };
    [[nodiscard]] std::optional<Timed> take_timed();

  private:
    /// One of the application's.
    struct Given {
        VkFormat format = VK_FORMAT_UNDEFINED;
        PictureSize size;
        std::uint32_t array_layers = 1;
        bool can_be_read = false;
        std::vector<VkImage> images;
        std::deque<std::uint32_t> acquired;
        bool waited = false;
        std::optional<std::uint32_t> released;  ///< the image that was released last
        bool release_held = false;              ///< below, it is acquired yet
    };
    /// What a projection layer with four views is composited into.
    struct Target {
        VkFormat format = VK_FORMAT_UNDEFINED;
        gaze::PerEye<XrSwapchain> swapchains{};
        gaze::PerEye<std::vector<VkImage>> images;
    };
    /// What is passed on for such a layer; it must stay where it is until the frame has ended.
    struct Passed {
        XrCompositionLayerProjection layer{};
        gaze::PerEye<XrCompositionLayerProjectionView> views{};
    };

    [[nodiscard]] XrResult check(const XrCompositionLayerProjection& layer) const;
    [[nodiscard]] GivenPicture picture(const XrSwapchainSubImage& image) const;
    void compose(const XrCompositionLayerProjection& layer, std::size_t number, Passed& passed,
                 std::optional<std::uint64_t> frame);
    [[nodiscard]] Target& target(std::size_t number, VkFormat format);
    void destroy(Target& target);
    XrResult release_below(XrSwapchain swapchain, Given& given);
    void release_all_below();
    [[nodiscard]] std::vector<VkImage> images_of(XrSwapchain swapchain) const;

    const NextFunctions& next_;
    XrSession session_;
    ApplicationDevice device_;
    QuadSizes sizes_;
    InsetPolicy policy_;

    mutable std::mutex mutex_;
    bool four_views_ = false;
    std::map<XrSwapchain, Given> given_;
    std::unique_ptr<InsetComposite> composite_;  ///< made with the first frame of four views
    bool cannot_composite_ = false;
    std::deque<Target> targets_;
    std::deque<Passed> passed_;
    std::vector<const XrCompositionLayerBaseHeader*> layers_;
    /// By the number of a composite, modulo size: the frame that it belongs to.
    std::array<std::optional<std::uint64_t>, 16> frames_;
    std::uint64_t composites_ = 0;
};

}  // namespace gazeloop::openxr_layer
