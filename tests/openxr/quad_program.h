#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/openxr/instance.h"
#include "runtime/openxr/vulkan_objects.h"
#include "runtime/render/host_picture.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::tests {

/// How the calls of an application come to the runtime.
enum class QuadWay : std::uint8_t {
    /// Through the layer's code in this process, and from there to the loader, where the pictures
    /// that the runtime gets are read back.
    InProcess,
    /// The same for an application of OpenXR 1.1, which needs no extension for its four views. (No
    /// loader before 1.1 lets it in itself.)
    InProcessCore,
    /// As everybody's: to the loader, which loads the layers of the environment.
    Loader,
};

/// An application of OpenXR with four views that draws with Vulkan, on Monado's null compositor.
class QuadProgram {
  public:
    /// Linear light where a ray hits the plane at distance 1 in front of an eye: x to the right, y
    /// up.
    using Scene = std::function<glm::vec3(double x, double y)>;

    /// `side_px`: of the display's pictures, for a right angle. Failures throw.
    QuadProgram(Scene scene, std::uint32_t side_px, QuadWay way = QuadWay::InProcess);
    QuadProgram(const QuadProgram&) = delete;
    QuadProgram& operator=(const QuadProgram&) = delete;
    ~QuadProgram();

    struct Frame {
        std::array<XrView, 4> views{};
        /// What the runtime got; nothing where the loader stands between.
        gaze::PerEye<render::LinearPicture> shown;
    };
    /// Draws so many frames; the last one.
    Frame run(int frames);

    /// What a view sees, in its own size; values are those that 8 bits of sRGB hold.
    [[nodiscard]] static render::LinearPicture seen(const Scene& scene, const XrFovf& fov,
                                                    std::uint32_t width, std::uint32_t height);
    [[nodiscard]] const std::vector<XrViewConfigurationView>& sizes() const { return sizes_; }
    [[nodiscard]] std::uint64_t validation_messages() const {
        return context_.validation_messages();
    }
    /// Ends the session, so that its recording is whole.
    void end();

  private:
    struct Swapchain {
        XrSwapchain handle = XR_NULL_HANDLE;
        std::vector<VkImage> images;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
    };

    template <typename Function>
    [[nodiscard]] Function call(const char* name) const;
    void begin_session();
    /// The session's next state, where the runtime has told one.
    std::optional<XrSessionState> poll();
    void make_swapchains();
    void draw(Swapchain& swapchain, const XrFovf& fov);

    Scene scene_;
    QuadWay way_;
    openxr::RuntimeChoice choice_;
    openxr::Instance instance_;
    openxr::VulkanObjects vulkan_;
    vulkan::Context context_;
    XrSession session_ = XR_NULL_HANDLE;
    XrSpace local_ = XR_NULL_HANDLE;
    std::vector<XrViewConfigurationView> sizes_;
    std::vector<Swapchain> swapchains_;
};

}  // namespace gazeloop::tests
