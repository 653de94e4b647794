#include "runtime/openxr_layer/eye_bindings.h"

#include <algorithm>
#include <optional>

namespace gazeloop::openxr_layer {

void EyeBindings::remove_set(XrActionSet set) {
    priorities_.erase(set);
    std::erase_if(actions_, [set](const auto& one) { return one.second.set == set; });
}

bool EyeBindings::declares_eyes(XrAction action) const {
    const auto found = actions_.find(action);
    return found != actions_.end() && found->second.eyes;
}

void EyeBindings::suggest(std::span<const XrAction> actions) {
    suggested_.assign(actions.begin(), actions.end());
}

XrActionSet EyeBindings::set_of(XrAction action) const {
    const auto found = actions_.find(action);
    return found != actions_.end() ? found->second.set : XR_NULL_HANDLE;
}

bool EyeBindings::is_bound(XrAction action) const {
    return std::ranges::find(suggested_, action) != suggested_.end() && actions_.contains(action);
}

bool EyeBindings::is_in(XrAction action, std::span<const XrActionSet> sets) const {
    const XrActionSet set = set_of(action);
    return set != XR_NULL_HANDLE && std::ranges::find(sets, set) != sets.end();
}

bool EyeBindings::binds_any(std::span<const XrActionSet> sets) const {
    return std::ranges::any_of(suggested_, [&](XrAction action) { return is_in(action, sets); });
}

void EyeBindings::active(std::span<const SyncedSet> synced, std::vector<XrAction>& active) const {
    active.clear();
    std::optional<std::uint32_t> highest;
    for (const XrAction action : suggested_) {
        const XrActionSet set = set_of(action);
        const bool is_synced = std::ranges::any_of(
            synced, [set](const SyncedSet& one) { return one.set == set && one.eyes; });
        const auto priority = priorities_.find(set);
        if (!is_synced || priority == priorities_.end() ||
            (highest && priority->second < *highest)) {
            continue;
        }
        if (!highest || priority->second > *highest) {
            highest = priority->second;
            active.clear();
        }
        active.push_back(action);
    }
}

}  // namespace gazeloop::openxr_layer
