#include "runtime/scene/light_field_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gazeloop::scene {
namespace {

/// Enough that a copy's overhead does not count.
constexpr std::uint32_t kStaged = 4;

std::uint32_t needed_views(const light_field::LightField& field) {
    return std::min(field.cameras.count(), 2 * light_field::most_views(field));
}

/// The greatest number of views that an image may have within so many bytes.
std::uint32_t most_layers_within(std::uint64_t bytes, const StorageLimits& limits,
                                 std::uint32_t views) {
    const std::uint64_t most = std::min(bytes, limits.most_image_bytes);
    std::uint32_t fit = 0;
    for (std::uint32_t step = std::uint32_t{1} << 31U; step > 0; step /= 2) {
        const std::uint32_t tried = fit + step;
        if (tried <= std::min(limits.most_layers, views) && limits.image_bytes(tried) <= most) {
            fit = tried;
        }
    }
    return fit;
}

/// The widest lens that asks for no more views than there are layers, m, in steps of a tenth of the
/// spacing; none: not even one without an opening.
std::optional<double> widest_lens_m(light_field::LightField field, std::uint32_t layers) {
    std::optional<double> widest;
    const double step_m = 0.1 * field.cameras.spacing_m;
    for (int step = 0; step * step_m < field.lens.aperture_m; ++step) {
        light_field::LightField tried = field;
        tried.lens.aperture_m = step * step_m;
        if (needed_views(tried) > layers) {
            break;
        }
        widest = tried.lens.aperture_m;
    }
    return widest;
}

std::uint64_t mib(std::uint64_t bytes) { return (bytes + (1U << 20U) - 1) >> 20U; }

}  // namespace

Expected<LightFieldStorage> choose_storage(const light_field::LightField& field,
                                           const StoredViews& views, const StorageLimits& limits) {
    const std::uint32_t all = field.cameras.count();
    if (most_layers_within(limits.most_bytes, limits, all) == all) {
        return LightFieldStorage{.layers = all, .staged = std::min(kStaged, all)};
    }
    const auto layers_beside = [&](std::uint32_t staged) {
        const std::uint64_t taken = staged * views.bytes;
        return limits.most_bytes > taken
                   ? most_layers_within(limits.most_bytes - taken, limits, all)
                   : 0;
    };
    const std::uint32_t needed = needed_views(field);
    for (std::uint32_t ahead = limits.most_ahead; ahead > 0; --ahead) {
        if (const std::uint32_t layers = layers_beside(kStaged + ahead); layers >= needed + ahead) {
            return LightFieldStorage{
                .layers = layers, .staged = kStaged, .ahead = ahead, .streamed = true};
        }
    }
    const std::uint32_t layers = layers_beside(kStaged);
    if (layers >= needed) {
        return LightFieldStorage{.layers = layers, .staged = kStaged, .streamed = true};
    }
    const std::uint64_t staging = kStaged * views.bytes;
    std::string remedies;
    if (const auto widest_m = field.lens.every_view ? std::nullopt : widest_lens_m(field, layers)) {
        remedies += fmt::format("a lens of lightfield.aperture_m = {:.4g}, ", *widest_m);
    }
    constexpr std::uint64_t kBc1Share = 8;
    if (!views.compressed && layers * kBc1Share >= needed) {
        remedies += "lightfield.compression = bc1 (an eighth, with loss), ";
    }
    // An image of more layers than the device has cannot be asked about.
    const std::uint64_t needed_bytes = needed <= limits.most_layers
                                           ? limits.image_bytes(needed)
                                           : std::uint64_t{needed} * views.bytes;
    const auto smaller_px = static_cast<std::uint32_t>(
        views.width_px * std::sqrt(static_cast<double>(layers) / needed));
    if (smaller_px > 0) {
        remedies += fmt::format("views of {} px across (gazeloop simulate light-field --size), ",
                                smaller_px);
    }
    return std::unexpected(Error{
        ErrorKind::BadInput,
        fmt::format("{}: two eyes' pictures are made of up to {} of the {} views of {}x{} px at a "
                    "time, which take {} MiB of the GPU's memory; they may take {} "
                    "(lightfield.memory_mib), which holds {} (this device: {} views and {} MiB in "
                    "one image). {}",
                    views.name, needed, all, views.width_px, views.height_px,
                    mib(needed_bytes + (needed < all ? staging : 0)), limits.most_bytes >> 20U,
                    layers, limits.most_layers, limits.most_image_bytes >> 20U,
                    remedies.empty() ? "Allow more"
                                     : fmt::format("These would fit: {}or allow more", remedies))});
}

}  // namespace gazeloop::scene
