#include "runtime/scene/light_field_views.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <numeric>

#include "runtime/error.h"
#include "runtime/scene/block_compression.h"

namespace gazeloop::scene {
namespace {

constexpr auto kUsage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;

vulkan::LayeredImage::Form form_of(const LightFieldSource& source, const LightFieldMemory& memory,
                                   std::uint32_t layers) {
    return {.extent = vk::Extent2D(source.width_px, source.height_px),
            .format = memory.compressed ? vk::Format::eBc1RgbSrgbBlock : vk::Format::eR8G8B8A8Srgb,
            .usage = kUsage,
            .layers = layers,
            .view = vk::ImageViewType::e2DArray};
}

std::uint64_t bytes_of_view(const LightFieldSource& source, const LightFieldMemory& memory) {
    return memory.compressed ? bc1_bytes(source.width_px, source.height_px)
                             : std::uint64_t{4} * source.width_px * source.height_px;
}

LightFieldStorage storage_for(const vulkan::Context& context, const LightFieldSource& source,
                              const light_field::Lens& lens, const LightFieldMemory& memory) {
    const vulkan::LayeredImage::Form one = form_of(source, memory, 1);
    constexpr auto kNeeded = vk::FormatFeatureFlagBits::eSampledImage |
                             vk::FormatFeatureFlagBits::eSampledImageFilterLinear |
                             vk::FormatFeatureFlagBits::eTransferDst;
    const auto features = context.physical().getFormatProperties(one.format).optimalTilingFeatures;
    if (memory.compressed && (!context.has_bc_textures() || (features & kNeeded) != kNeeded)) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{} reads no textures in BC1: lightfield.compression = none",
                                     context.device_name()));
    }
    const vk::ImageFormatProperties most = context.physical().getImageFormatProperties(
        one.format, vk::ImageType::e2D, vk::ImageTiling::eOptimal, kUsage);
    if (one.extent.width > most.maxExtent.width || one.extent.height > most.maxExtent.height) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{}: views of {}x{} px are larger than an image of this device, {} px a "
                        "side",
                        source.name, source.width_px, source.height_px, most.maxExtent.width));
    }
    return value_or_throw(choose_storage(
        {.cameras = source.cameras, .lens = lens},
        {.name = source.name,
         .width_px = source.width_px,
         .height_px = source.height_px,
         .bytes = bytes_of_view(source, memory),
         .compressed = memory.compressed},
        {.most_bytes = memory.most_bytes,
         .most_layers = most.maxArrayLayers,
         .image_bytes =
             [&](std::uint32_t layers) {
                 return vulkan::memory_needed(context, form_of(source, memory, layers));
             },
         .most_image_bytes = std::min(most.maxResourceSize, vulkan::most_memory(context))}));
}

}  // namespace

LightFieldViews::LightFieldViews(const vulkan::Context& context, const LightFieldSource& source,
                                 const light_field::Lens& lens, const LightFieldMemory& memory)
    : context_(context),
      view_bytes_(bytes_of_view(source, memory)),
      views_(source.cameras.count()),
      storage_(storage_for(context, source, lens, memory)),
      image_(context, form_of(source, memory, storage_.layers)),
      staging_(context, storage_.staged * view_bytes_, vk::BufferUsageFlagBits::eTransferSrc),
      resident_(views_, storage_.layers) {
    vulkan::make_readable(context, image_);
    LightFieldSource::Prepare prepare;
    if (memory.compressed) {
        prepare = [&](const LightFieldSource::Texels& texels) {
            return compress_bc1(texels, source.width_px, source.height_px);
        };
    }
    if (storage_.streamed) {
        scratch_.emplace(value_or_throw(memory::ScratchFile::make()));
        value_or_throw(scratch_->reserve(views_ * view_bytes_));
        value_or_throw(source.read(prepare, [&](std::uint32_t view, const auto& texels) {
            return scratch_->write(view * view_bytes_, texels);
        }));
        spdlog::info(
            "{}: {} views take {} MiB, more than they may (lightfield.memory_mib): {} at a time "
            "are kept, in {} MiB, and frames wait for others",
            source.name, views_, (views_ * view_bytes_) >> 20U, storage_.layers,
            memory_bytes() >> 20U);
        return;
    }
    std::vector<std::uint32_t> all(views_);
    std::iota(all.begin(), all.end(), 0);
    (void)resident_.request(all);
    std::vector<vulkan::LayerSource> staged;
    value_or_throw(source.read(prepare, [&](std::uint32_t view, const auto& texels) {
        const std::uint64_t offset = staged.size() * view_bytes_;
        staging_.write(std::span<const std::byte>(texels), offset);
        staged.push_back({resident_.layer_of(view), offset});
        if (staged.size() == storage_.staged) {
            flush(staged);
        }
        return Expected<void>{};
    }));
    flush(staged);
    staging_ = {};
}

void LightFieldViews::flush(std::vector<vulkan::LayerSource>& staged) const {
    if (!staged.empty()) {
        vulkan::replace_layers(context_, image_, staging_.buffer(), staged);
        staged.clear();
    }
}

void LightFieldViews::bring(std::span<const std::uint32_t> wanted) {
    if (!storage_.streamed) {
        return;
    }
    const auto loads = resident_.request(wanted);
    loaded_ += loads.size();
    waiting_frames_ += loads.empty() ? 0 : 1;
    most_in_a_frame_ = std::max<std::uint64_t>(most_in_a_frame_, loads.size());
    std::vector<vulkan::LayerSource> staged;
    for (const light_field::ResidentViews::Load& load : loads) {
        const std::uint64_t offset = staged.size() * view_bytes_;
        value_or_throw(scratch_->read(load.view * view_bytes_,
                                      staging_.mapped().subspan(offset, view_bytes_)));
        staged.push_back({load.layer, offset});
        if (staged.size() == storage_.staged) {
            flush(staged);
        }
    }
    flush(staged);
}

std::uint64_t LightFieldViews::memory_bytes() const {
    return image_.memory_bytes() + staging_.size();
}

std::optional<std::string> LightFieldViews::account() const {
    if (!storage_.streamed) {
        return std::nullopt;
    }
    return fmt::format(
        "{} of {} views at a time, in {} MiB: {} frames waited for {} views, none for more than {}",
        storage_.layers, views_, memory_bytes() >> 20U, waiting_frames_, loaded_, most_in_a_frame_);
}

}  // namespace gazeloop::scene
