#include "tests/openxr/quad_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <utility>

#include "runtime/openxr_layer/instance_creation.h"
#include "runtime/openxr_layer/next_functions.h"
#include "runtime/openxr_layer/quad_views/quad_sizes.h"
#include "runtime/render/srgb.h"
#include "runtime/time/clock.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/run_once.h"
#include "tests/support/layer_in_process.h"

namespace gazeloop::tests {

using openxr::typed;
using openxr::xr_check;

namespace {

constexpr auto kFormat = VK_FORMAT_R8G8B8A8_SRGB;

/// The swapchains that were made below the layer, and the pictures of the frame that ended last.
struct Below {
    struct Known {
        std::vector<VkImage> images;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::uint32_t acquired = 0;  ///< the image that was acquired last
    };
    std::map<XrSwapchain, Known> swapchains;
    const vulkan::Context* context = nullptr;
    bool reads = false;
    std::vector<render::LinearPicture> shown;
};
Below g_below;

std::vector<VkImage> images_of(XrSwapchain swapchain) {
    std::uint32_t count = 0;
    xr_check(xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr),
             "xrEnumerateSwapchainImages");
    std::vector<XrSwapchainImageVulkan2KHR> images(
        count, typed<XrSwapchainImageVulkan2KHR>(XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR));
    xr_check(
        xrEnumerateSwapchainImages(swapchain, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
    std::vector<VkImage> all;
    all.reserve(images.size());
    for (const auto& image : images) {
        all.push_back(image.image);
    }
    return all;
}

void move(const vk::raii::CommandBuffer& commands, VkImage image, vk::ImageLayout from,
          vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier(
        vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
        vk::PipelineStageFlagBits2::eAllCommands,
        vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, from, to,
        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
        {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

vk::BufferImageCopy whole(std::uint32_t width, std::uint32_t height) {
    return {0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0}, {width, height, 1}};
}

render::LinearPicture read(const Below::Known& known) {
    const vulkan::Context& context = *g_below.context;
    const vulkan::HostBuffer buffer(context, std::uint64_t{known.width} * known.height * 4,
                                    vk::BufferUsageFlagBits::eTransferDst);
    const VkImage image = known.images.at(known.acquired);
    vulkan::run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        move(commands, image, vk::ImageLayout::eColorAttachmentOptimal,
             vk::ImageLayout::eTransferSrcOptimal);
        commands.copyImageToBuffer(image, vk::ImageLayout::eTransferSrcOptimal, buffer.buffer(),
                                   whole(known.width, known.height));
        move(commands, image, vk::ImageLayout::eTransferSrcOptimal,
             vk::ImageLayout::eColorAttachmentOptimal);
    });
    render::LinearPicture picture{known.width, known.height, {}};
    const auto bytes = buffer.mapped();
    for (std::size_t at = 0; at < bytes.size(); at += 4) {
        picture.pixels.push_back(render::linear_of({static_cast<std::uint8_t>(bytes[at]),
                                                    static_cast<std::uint8_t>(bytes[at + 1]),
                                                    static_cast<std::uint8_t>(bytes[at + 2])}));
    }
    return picture;
}

XRAPI_ATTR XrResult XRAPI_CALL keep_instance(XrInstance) { return XR_SUCCESS; }

XRAPI_ATTR XrResult XRAPI_CALL create_swapchain(XrSession session,
                                                const XrSwapchainCreateInfo* info,
                                                XrSwapchain* swapchain) {
    XrSwapchainCreateInfo readable = *info;
    readable.usageFlags |= XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT;
    const XrResult result = xrCreateSwapchain(session, &readable, swapchain);
    if (XR_SUCCEEDED(result)) {
        g_below.swapchains[*swapchain] = {images_of(*swapchain), info->width, info->height, 0};
    }
    return result;
}
XRAPI_ATTR XrResult XRAPI_CALL acquire_image(XrSwapchain swapchain,
                                             const XrSwapchainImageAcquireInfo* info,
                                             std::uint32_t* index) {
    const XrResult result = xrAcquireSwapchainImage(swapchain, info, index);
    if (XR_SUCCEEDED(result)) {
        g_below.swapchains[swapchain].acquired = *index;
    }
    return result;
}
XRAPI_ATTR XrResult XRAPI_CALL end_frame(XrSession session, const XrFrameEndInfo* info) {
    if (g_below.reads && info->layerCount == 1) {
        const auto& projection =
            *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[0]);
        g_below.shown.clear();
        for (std::uint32_t view = 0; view < projection.viewCount; ++view) {
            g_below.shown.push_back(
                read(g_below.swapchains.at(projection.views[view].subImage.swapchain)));
        }
    }
    return xrEndFrame(session, info);
}

XRAPI_ATTR XrResult XRAPI_CALL below(XrInstance instance, const char* name,
                                     PFN_xrVoidFunction* function) {
    const std::map<std::string_view, PFN_xrVoidFunction> own{
        {"xrDestroyInstance", reinterpret_cast<PFN_xrVoidFunction>(&keep_instance)},
        {"xrCreateSwapchain", reinterpret_cast<PFN_xrVoidFunction>(&create_swapchain)},
        {"xrAcquireSwapchainImage", reinterpret_cast<PFN_xrVoidFunction>(&acquire_image)},
        {"xrEndFrame", reinterpret_cast<PFN_xrVoidFunction>(&end_frame)}};
    if (const auto found = own.find(name); found != own.end()) {
        *function = found->second;
        return XR_SUCCESS;
    }
    return xrGetInstanceProcAddr(instance, name, function);
}

vulkan::ContextOptions with_validation() {
    vulkan::ContextOptions options;
    options.validation = true;
    return options;
}

openxr::InstanceOptions wishes_of(QuadWay way) {
    openxr::InstanceOptions options;
    if (way == QuadWay::Loader) {
        options.wanted.push_back(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME);
    }
    return options;
}

display::DisplayProfile display_of(std::uint32_t side_px) {
    display::DisplayProfile display;
    display.width_px = display.height_px = side_px;
    display.refresh_hz = 60.0;
    constexpr double kHalf_rad = std::numbers::pi / 4.0;
    display.fov.fill({-kHalf_rad, kHalf_rad, kHalf_rad, -kHalf_rad});
    return display;
}

}  // namespace

template <typename Function>
Function QuadProgram::call(const char* name) const {
    const auto find =
        way_ == QuadWay::Loader ? &xrGetInstanceProcAddr : &openxr_layer::get_instance_proc_addr;
    const auto function = openxr_layer::function_of<Function>(find, instance_.handle(), name);
    if (function == nullptr) {
        throw std::runtime_error(name);
    }
    return function;
}

QuadProgram::QuadProgram(Scene scene, std::uint32_t side_px, QuadWay way)
    : scene_(std::move(scene)),
      way_(way),
      choice_(openxr::choose_runtime(display_of(side_px))),
      instance_(choice_, wishes_of(way)),
      vulkan_(instance_),
      context_(with_validation(), &vulkan_) {
    g_below = {};
    g_below.context = &context_;
    AskedInstance asked{.application = "four views",
                        .extensions = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME}};
    if (way == QuadWay::InProcessCore) {
        asked.version = XR_MAKE_VERSION(1, 1, 0);
    } else {
        asked.extensions.push_back(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME);
    }
    if (way != QuadWay::Loader) {
        put_layer_above(instance_.handle(), asked, &below);
    }
    begin_session();
    make_swapchains();
}

QuadProgram::~QuadProgram() {
    try {
        end();
        if (way_ != QuadWay::Loader) {  // else it ends with its owner
            call<PFN_xrDestroyInstance>("xrDestroyInstance")(instance_.handle());
        }
    } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
    }
}

void QuadProgram::end() {
    if (session_ != XR_NULL_HANDLE) {
        context_.device().waitIdle();
        call<PFN_xrDestroySession>("xrDestroySession")(std::exchange(session_, XR_NULL_HANDLE));
    }
}

void QuadProgram::begin_session() {
    auto binding = typed<XrGraphicsBindingVulkan2KHR>(XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR);
    binding.instance = *context_.instance();
    binding.physicalDevice = *context_.physical();
    binding.device = *context_.device();
    binding.queueFamilyIndex = context_.queue_family();
    auto info = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
    info.next = &binding;
    info.systemId = instance_.system();
    xr_check(call<PFN_xrCreateSession>("xrCreateSession")(instance_.handle(), &info, &session_),
             "xrCreateSession");
    auto space = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    space.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
    space.poseInReferenceSpace = openxr::to_xr({});
    xr_check(call<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session_, &space, &local_),
             "xrCreateReferenceSpace");
    const std::int64_t deadline_ns = time::monotonic_ns() + 10'000'000'000;
    for (auto state = XR_SESSION_STATE_UNKNOWN; state != XR_SESSION_STATE_READY;) {
        state = poll().value_or(state);
        if (time::monotonic_ns() > deadline_ns) {
            throw std::runtime_error("the session never became ready");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    auto begin = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    begin.primaryViewConfigurationType = openxr_layer::kQuadViews;
    xr_check(call<PFN_xrBeginSession>("xrBeginSession")(session_, &begin), "xrBeginSession");
}

std::optional<XrSessionState> QuadProgram::poll() {
    std::optional<XrSessionState> state;
    auto event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    while (!state &&
           call<PFN_xrPollEvent>("xrPollEvent")(instance_.handle(), &event) == XR_SUCCESS) {
        if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
            XrEventDataSessionStateChanged changed{};
            std::memcpy(&changed, &event, sizeof changed);
            state = changed.state;
        }
        event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    }
    return state;
}

void QuadProgram::make_swapchains() {
    sizes_.assign(openxr_layer::kQuadViewCount,
                  typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
    std::uint32_t count = 0;
    xr_check(call<PFN_xrEnumerateViewConfigurationViews>("xrEnumerateViewConfigurationViews")(
                 instance_.handle(), instance_.system(), openxr_layer::kQuadViews,
                 openxr_layer::kQuadViewCount, &count, sizes_.data()),
             "xrEnumerateViewConfigurationViews");
    for (const XrViewConfigurationView& size : sizes_) {
        auto info = typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
        info.usageFlags =
            XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
        info.format = kFormat;
        info.width = size.recommendedImageRectWidth;
        info.height = size.recommendedImageRectHeight;
        info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
        Swapchain made{
            .handle = XR_NULL_HANDLE, .images = {}, .width = info.width, .height = info.height};
        xr_check(call<PFN_xrCreateSwapchain>("xrCreateSwapchain")(session_, &info, &made.handle),
                 "xrCreateSwapchain");
        made.images = images_of(made.handle);
        swapchains_.push_back(std::move(made));
    }
}

namespace {

std::uint8_t code_of(float linear) {
    return static_cast<std::uint8_t>(std::lround(255.0 * render::srgb_encoded(linear)));
}

/// sRGB, four bytes for each pixel.
std::vector<std::uint8_t> drawn(const QuadProgram::Scene& scene, const XrFovf& fov,
                                std::uint32_t width, std::uint32_t height) {
    const double left = std::tan(fov.angleLeft);
    const double up = std::tan(fov.angleUp);
    const double across = (std::tan(fov.angleRight) - left) / width;
    const double down = (up - std::tan(fov.angleDown)) / height;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(std::size_t{width} * height * 4);
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < width; ++column) {
            const glm::vec3 colour = scene(left + (column + 0.5) * across, up - (row + 0.5) * down);
            bytes.insert(bytes.end(), {code_of(colour.x), code_of(colour.y), code_of(colour.z),
                                       std::uint8_t{255}});
        }
    }
    return bytes;
}

}  // namespace

render::LinearPicture QuadProgram::seen(const Scene& scene, const XrFovf& fov, std::uint32_t width,
                                        std::uint32_t height) {
    const std::vector<std::uint8_t> bytes = drawn(scene, fov, width, height);
    render::LinearPicture picture{width, height, {}};
    for (std::size_t at = 0; at < bytes.size(); at += 4) {
        picture.pixels.push_back(render::linear_of({bytes[at], bytes[at + 1], bytes[at + 2]}));
    }
    return picture;
}

void QuadProgram::draw(Swapchain& swapchain, const XrFovf& fov) {
    std::uint32_t index = 0;
    const auto acquire = typed<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
    xr_check(call<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(swapchain.handle,
                                                                          &acquire, &index),
             "xrAcquireSwapchainImage");
    auto wait = typed<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    wait.timeout = XR_INFINITE_DURATION;
    xr_check(call<PFN_xrWaitSwapchainImage>("xrWaitSwapchainImage")(swapchain.handle, &wait),
             "xrWaitSwapchainImage");
    const std::vector<std::uint8_t> bytes = drawn(scene_, fov, swapchain.width, swapchain.height);
    vulkan::HostBuffer buffer(context_, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc);
    buffer.write(std::span<const std::uint8_t>(bytes));
    const VkImage image = swapchain.images.at(index);
    vulkan::run_once(context_, [&](const vk::raii::CommandBuffer& commands) {
        move(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        commands.copyBufferToImage(buffer.buffer(), image, vk::ImageLayout::eTransferDstOptimal,
                                   whole(swapchain.width, swapchain.height));
        move(commands, image, vk::ImageLayout::eTransferDstOptimal,
             vk::ImageLayout::eColorAttachmentOptimal);
    });
    const auto release = typed<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
    xr_check(
        call<PFN_xrReleaseSwapchainImage>("xrReleaseSwapchainImage")(swapchain.handle, &release),
        "xrReleaseSwapchainImage");
}

QuadProgram::Frame QuadProgram::run(int frames) {
    Frame frame;
    for (int i = 0; i < frames; ++i) {
        while (poll()) {
        }
        g_below.reads = way_ != QuadWay::Loader && i == frames - 1;
        const auto wait = typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
        auto state = typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        xr_check(call<PFN_xrWaitFrame>("xrWaitFrame")(session_, &wait, &state), "xrWaitFrame");
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        xr_check(call<PFN_xrBeginFrame>("xrBeginFrame")(session_, &begin), "xrBeginFrame");
        auto locate = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
        locate.viewConfigurationType = openxr_layer::kQuadViews;
        locate.displayTime = state.predictedDisplayTime;
        locate.space = local_;
        auto view_state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
        frame.views.fill(typed<XrView>(XR_TYPE_VIEW));
        std::uint32_t count = 0;
        xr_check(call<PFN_xrLocateViews>("xrLocateViews")(session_, &locate, &view_state,
                                                          openxr_layer::kQuadViewCount, &count,
                                                          frame.views.data()),
                 "xrLocateViews");
        std::array<XrCompositionLayerProjectionView, openxr_layer::kQuadViewCount> pictures{};
        for (std::size_t view = 0; view < pictures.size(); ++view) {
            Swapchain& swapchain = swapchains_[view];
            draw(swapchain, frame.views[view].fov);
            pictures[view] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                              nullptr,
                              frame.views[view].pose,
                              frame.views[view].fov,
                              {swapchain.handle,
                               {{0, 0},
                                {static_cast<std::int32_t>(swapchain.width),
                                 static_cast<std::int32_t>(swapchain.height)}},
                               0}};
        }
        auto projection = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
        projection.space = local_;
        projection.viewCount = openxr_layer::kQuadViewCount;
        projection.views = pictures.data();
        const auto* const shown =
            reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
        auto end = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        end.displayTime = state.predictedDisplayTime;
        end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
        end.layerCount = 1;
        end.layers = &shown;
        xr_check(call<PFN_xrEndFrame>("xrEndFrame")(session_, &end), "xrEndFrame");
    }
    if (way_ == QuadWay::Loader) {
        return frame;
    }
    if (g_below.shown.size() != gaze::kEyeCount) {
        throw std::runtime_error("the runtime got no two pictures");
    }
    frame.shown = {g_below.shown[0], g_below.shown[1]};
    return frame;
}

}  // namespace gazeloop::tests
