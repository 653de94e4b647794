#include "runtime/light_field/resident_views.h"

#include <algorithm>

namespace gazeloop::light_field {

ResidentViews::ResidentViews(std::uint32_t views, std::uint32_t layers)
    : layer_of_(views, kNone), view_in_(layers, kNone), asked_(views, 0), ahead_(views, false) {
    loads_.reserve(layers);
}

std::span<const ResidentViews::Load> ResidentViews::request(std::span<const std::uint32_t> wanted) {
    ++request_;
    // All are marked before any makes room for itself, so that none takes another one's layer.
    for (const std::uint32_t view : wanted) {
        asked_[view] = stamp_of_request();
        fetched_and_wanted_ += ahead_[view] ? 1 : 0;
        ahead_[view] = false;
    }
    loads_.clear();
    for (const std::uint32_t view : wanted) {
        if (!is_resident(view)) {
            load(view, layer_to_free());
        }
    }
    return loads_;
}

std::span<const ResidentViews::Load> ResidentViews::fetch_ahead(
    std::span<const std::uint32_t> likely, std::uint32_t most) {
    loads_.clear();
    for (const std::uint32_t view : likely) {
        if (is_wanted(view)) {
            continue;
        }
        if (!is_resident(view)) {
            if (loads_.size() == most) {
                continue;
            }
            const std::uint32_t layer = layer_to_free();
            const std::uint32_t gone = view_in_[layer];
            if (gone != kNone && asked_[gone] >= stamp_of_likely()) {
                break;  // what has a layer is likelier, or asked for
            }
            load(view, layer);
            ahead_[view] = true;
            ++fetched_;
        }
        asked_[view] = stamp_of_likely();
    }
    return loads_;
}

/// A layer that is free, else the one whose view was asked for longest ago; of several the first.
std::uint32_t ResidentViews::layer_to_free() const {
    const auto longest_ago = std::ranges::min_element(view_in_, {}, [&](std::uint32_t view) {
        return view == kNone ? std::uint64_t{0} : asked_[view];
    });
    return static_cast<std::uint32_t>(longest_ago - view_in_.begin());
}

void ResidentViews::load(std::uint32_t view, std::uint32_t layer) {
    if (const std::uint32_t gone = view_in_[layer]; gone != kNone) {
        layer_of_[gone] = kNone;
        ahead_[gone] = false;
    }
    view_in_[layer] = view;
    layer_of_[view] = layer;
    loads_.push_back({view, layer});
}

}  // namespace gazeloop::light_field
