#include "runtime/light_field/resident_views.h"

#include <algorithm>

namespace gazeloop::light_field {

ResidentViews::ResidentViews(std::uint32_t views, std::uint32_t layers)
    : layer_of_(views, kNone), view_in_(layers, kNone), asked_(views, 0) {
    loads_.reserve(layers);
}

std::span<const ResidentViews::Load> ResidentViews::request(std::span<const std::uint32_t> wanted) {
    ++request_;
    // All are marked before any makes room for itself, so that none takes another one's layer.
    for (const std::uint32_t view : wanted) {
        asked_[view] = request_;
    }
    loads_.clear();
    for (const std::uint32_t view : wanted) {
        if (!is_resident(view)) {
            const std::uint32_t layer = make_room();
            view_in_[layer] = view;
            layer_of_[view] = layer;
            loads_.push_back({view, layer});
        }
    }
    return loads_;
}

/// A layer that is free, else the one whose view was asked for longest ago; of several the first.
std::uint32_t ResidentViews::make_room() {
    const auto longest_ago = std::ranges::min_element(view_in_, {}, [&](std::uint32_t view) {
        return view == kNone ? std::uint64_t{0} : asked_[view];
    });
    if (*longest_ago != kNone) {
        layer_of_[*longest_ago] = kNone;
    }
    return static_cast<std::uint32_t>(longest_ago - view_in_.begin());
}

}  // namespace gazeloop::light_field
