#include "runtime/openxr_layer/quad_views/quad_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "runtime/openxr_layer/layer_log.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::uint32_t kFour = 4;

void check_xr(XrResult result, const char* call) {
    if (result != XR_SUCCESS && result != XR_SESSION_LOSS_PENDING) {
        throw std::runtime_error(fmt::format("{}: XrResult {}", call, static_cast<int>(result)));
    }
}

gaze::FieldOfView field_of(const XrFovf& fov) {
    return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
}

bool is_field(const XrFovf& fov) {
    return gaze::is_valid({.pose = {}, .fov = field_of(fov), .width_px = 1, .height_px = 1});
}

}  // namespace

QuadSession::~QuadSession() {
    try {
        for (Target& target : targets_) {
            destroy(target);
        }
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // The application ends its session either way, and must not end with it.
    }
}

void QuadSession::begin(bool with_four_views) {
    const std::lock_guard lock(mutex_);
    four_views_ = with_four_views;
}

bool QuadSession::has_four_views() const {
    const std::lock_guard lock(mutex_);
    return four_views_;
}

std::vector<VkImage> QuadSession::images_of(XrSwapchain swapchain) const {
    std::uint32_t count = 0;
    check_xr(next_.EnumerateSwapchainImages(swapchain, 0, &count, nullptr),
             "xrEnumerateSwapchainImages");
    std::vector<XrSwapchainImageVulkanKHR> images(
        count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR, nullptr, VK_NULL_HANDLE});
    check_xr(
        next_.EnumerateSwapchainImages(
            swapchain, count, &count, reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
    std::vector<VkImage> all;
    all.reserve(images.size());
    for (const XrSwapchainImageVulkanKHR& image : images) {
        all.push_back(image.image);
    }
    return all;
}

void QuadSession::add(XrSwapchain swapchain, const XrSwapchainCreateInfo& info) {
    Given given;
    given.format = static_cast<VkFormat>(info.format);
    given.size = {info.width, info.height};
    given.array_layers = info.arraySize;
    given.can_be_read = (info.usageFlags & XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT) != 0 &&
                        info.sampleCount == 1 && info.faceCount == 1;
    given.images = images_of(swapchain);
    const std::lock_guard lock(mutex_);
    given_[swapchain] = std::move(given);
}

void QuadSession::remove(XrSwapchain swapchain) {
    const std::lock_guard lock(mutex_);
    const auto found = given_.find(swapchain);
    if (found == given_.end()) {
        return;
    }
    if (composite_ != nullptr) {
        for (const VkImage image : found->second.images) {
            composite_->forget(image);
        }
    }
    given_.erase(found);
}

XrResult QuadSession::release_below(XrSwapchain swapchain, Given& given) {
    if (!std::exchange(given.release_held, false)) {
        return XR_SUCCESS;
    }
    XrSwapchainImageReleaseInfo info{};
    info.type = XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO;
    return next_.ReleaseSwapchainImage(swapchain, &info);
}

void QuadSession::release_all_below() {
    for (auto& [swapchain, given] : given_) {
        if (const XrResult result = release_below(swapchain, given); XR_FAILED(result)) {
            say(LogLevel::Warning,
                fmt::format("xrReleaseSwapchainImage: XrResult {}", static_cast<int>(result)));
        }
    }
}

XrResult QuadSession::acquire(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info,
                              std::uint32_t* index) {
    const std::lock_guard lock(mutex_);
    const auto found = given_.find(swapchain);
    if (found != given_.end()) {
        if (const XrResult result = release_below(swapchain, found->second); XR_FAILED(result)) {
            return result;
        }
    }
    const XrResult result = next_.AcquireSwapchainImage(swapchain, info, index);
    if (XR_SUCCEEDED(result) && found != given_.end()) {
        found->second.acquired.push_back(*index);
    }
    return result;
}

/// Without the lock: it may take as long as the runtime likes.
XrResult QuadSession::wait(XrSwapchain swapchain, const XrSwapchainImageWaitInfo* info) {
    const XrResult result = next_.WaitSwapchainImage(swapchain, info);
    if (result == XR_SUCCESS) {
        const std::lock_guard lock(mutex_);
        if (const auto found = given_.find(swapchain); found != given_.end()) {
            found->second.waited = true;
        }
    }
    return result;
}

XrResult QuadSession::release(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo* info) {
    const std::lock_guard lock(mutex_);
    const auto found = given_.find(swapchain);
    if (found != given_.end() && found->second.release_held) {
        return XR_ERROR_CALL_ORDER_INVALID;  // the runtime would release the one that is held
    }
    // What cannot be released, the runtime refuses.
    const bool hold = four_views_ && found != given_.end() && found->second.waited &&
                      !found->second.acquired.empty();
    if (!hold) {
        const XrResult result = next_.ReleaseSwapchainImage(swapchain, info);
        if (XR_FAILED(result) || found == given_.end()) {
            return result;
        }
    }
    Given& given = found->second;
    if (!given.acquired.empty()) {
        given.released = given.acquired.front();
        given.acquired.pop_front();
    }
    given.waited = false;
    given.release_held = hold;
    return XR_SUCCESS;
}

XrResult QuadSession::check(const XrCompositionLayerProjection& layer) const {
    if (layer.viewCount != kFour || layer.views == nullptr) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    for (std::uint32_t view = 0; view < kFour; ++view) {
        const XrSwapchainSubImage& image = layer.views[view].subImage;
        const auto found = given_.find(image.swapchain);
        if (found == given_.end()) {
            return XR_ERROR_HANDLE_INVALID;
        }
        const Given& given = found->second;
        if (!given.released) {
            return XR_ERROR_LAYER_INVALID;
        }
        if (image.imageArrayIndex >= given.array_layers) {
            return XR_ERROR_VALIDATION_FAILURE;
        }
        const XrRect2Di& rect = image.imageRect;
        const auto fits = [](std::int32_t offset, std::int32_t extent, std::uint32_t size) {
            return offset >= 0 && extent > 0 && std::int64_t{offset} + extent <= std::int64_t{size};
        };
        if (!fits(rect.offset.x, rect.extent.width, given.size.width_px) ||
            !fits(rect.offset.y, rect.extent.height, given.size.height_px)) {
            return XR_ERROR_SWAPCHAIN_RECT_INVALID;
        }
    }
    return XR_SUCCESS;
}

GivenPicture QuadSession::picture(const XrSwapchainSubImage& image) const {
    const Given& given = given_.at(image.swapchain);
    if (!given.can_be_read) {
        throw std::runtime_error(
            "a view is in a swapchain of several samples, or of no colours: its inset is not "
            "shown");
    }
    const XrRect2Di& rect = image.imageRect;
    return {.image = given.images.at(*given.released),
            .format = given.format,
            .array_layer = image.imageArrayIndex,
            .texture = given.size,
            .rect = {{rect.offset.x, rect.offset.y},
                     {static_cast<std::uint32_t>(rect.extent.width),
                      static_cast<std::uint32_t>(rect.extent.height)}}};
}

void QuadSession::destroy(Target& target) {
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        if (composite_ != nullptr) {
            for (const VkImage image : target.images[eye]) {
                composite_->forget(image);
            }
        }
        if (target.swapchains[eye] != XR_NULL_HANDLE) {
            next_.DestroySwapchain(target.swapchains[eye]);
        }
    }
    target = {};
}

QuadSession::Target& QuadSession::target(std::size_t number, VkFormat format) {
    while (targets_.size() <= number) {
        targets_.emplace_back();
    }
    Target& target = targets_[number];
    if (target.format == format) {
        return target;
    }
    destroy(target);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        XrSwapchainCreateInfo info{};
        info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
        info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
        info.format = format;
        info.sampleCount = 1;
        info.width = sizes_.full.width_px;
        info.height = sizes_.full.height_px;
        info.faceCount = 1;
        info.arraySize = 1;
        info.mipCount = 1;
        check_xr(next_.CreateSwapchain(session_, &info, &target.swapchains[eye]),
                 "xrCreateSwapchain");
        target.images[eye] = images_of(target.swapchains[eye]);
    }
    target.format = format;
    return target;
}

void QuadSession::compose(const XrCompositionLayerProjection& layer, std::size_t number,
                          Passed& passed, std::optional<std::uint64_t> frame) {
    gaze::PerEye<CompositedEye> eyes;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const XrCompositionLayerProjectionView& outer = layer.views[eye];
        const XrCompositionLayerProjectionView& inset = layer.views[eye + gaze::kEyeCount];
        if (!is_field(outer.fov) || !is_field(inset.fov)) {
            throw std::runtime_error("a view has no field of view: its inset is not shown");
        }
        eyes[eye].outer = picture(outer.subImage);
        eyes[eye].inset = picture(inset.subImage);
        eyes[eye].covers = part_of(field_of(outer.fov), field_of(inset.fov));
    }
    if (composite_ == nullptr) {
        auto made = InsetComposite::create(device_);
        if (!made) {
            throw std::runtime_error(made.error().message + ": insets are not shown");
        }
        composite_ = std::move(*made);
    }
    Target& into = target(number, eyes[0].outer.format);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        XrSwapchainImageAcquireInfo acquire{};
        acquire.type = XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO;
        std::uint32_t index = 0;
        check_xr(next_.AcquireSwapchainImage(into.swapchains[eye], &acquire, &index),
                 "xrAcquireSwapchainImage");
        XrSwapchainImageWaitInfo wait{};
        wait.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO;
        wait.timeout = XR_INFINITE_DURATION;
        check_xr(next_.WaitSwapchainImage(into.swapchains[eye], &wait), "xrWaitSwapchainImage");
        eyes[eye].target = into.images[eye].at(index);
    }
    frames_[composites_++ % frames_.size()] = frame;
    composite_->draw(eyes, sizes_.full, into.format, policy_.blend);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        XrSwapchainImageReleaseInfo release{};
        release.type = XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO;
        check_xr(next_.ReleaseSwapchainImage(into.swapchains[eye], &release),
                 "xrReleaseSwapchainImage");
        passed.views[eye].subImage = {into.swapchains[eye],
                                      {{0, 0},
                                       {static_cast<std::int32_t>(sizes_.full.width_px),
                                        static_cast<std::int32_t>(sizes_.full.height_px)}},
                                      0};
    }
}

XrResult QuadSession::end_frame(const XrFrameEndInfo& info, std::optional<std::uint64_t> frame) {
    const std::lock_guard lock(mutex_);
    layers_.clear();
    passed_.clear();
    std::size_t projections = 0;
    for (std::uint32_t i = 0; i < info.layerCount && info.layers != nullptr; ++i) {
        const XrCompositionLayerBaseHeader* const layer = info.layers[i];
        if (layer == nullptr || layer->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
            layers_.push_back(layer);
            continue;
        }
        const auto& projection = *reinterpret_cast<const XrCompositionLayerProjection*>(layer);
        if (const XrResult result = check(projection); XR_FAILED(result)) {
            return result;
        }
        Passed& passed = passed_.emplace_back();
        passed.layer = projection;
        passed.layer.viewCount = static_cast<std::uint32_t>(passed.views.size());
        passed.layer.views = passed.views.data();
        std::copy_n(projection.views, passed.views.size(), passed.views.begin());
        try {
            if (!cannot_composite_) {
                compose(projection, projections++, passed, frame);
            }
        } catch (const std::exception& error) {
            cannot_composite_ = true;
            say(LogLevel::Warning, error.what());
        }
        layers_.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&passed.layer));
    }
    release_all_below();
    XrFrameEndInfo passed_on = info;
    passed_on.layerCount = static_cast<std::uint32_t>(layers_.size());
    passed_on.layers = layers_.data();
    return next_.EndFrame(session_, &passed_on);
}

std::optional<QuadSession::Timed> QuadSession::take_timed() {
    const std::lock_guard lock(mutex_);
    while (composite_ != nullptr) {
        const auto timed = composite_->take_timed();
        if (!timed) {
            break;
        }
        if (const auto frame = frames_[timed->number % frames_.size()]) {
            return Timed{*frame, timed->ns};
        }
    }
    return std::nullopt;
}

}  // namespace gazeloop::openxr_layer
