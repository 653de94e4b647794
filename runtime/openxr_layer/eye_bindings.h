#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "runtime/openxr/xr_check.h"

namespace gazeloop::openxr_layer {

/// An action set that an application synchronizes, as far as the eyes are concerned.
struct SyncedSet {
    XrActionSet set = XR_NULL_HANDLE;
    bool eyes = true;  ///< synchronized for the eyes: for all, or for the eyes' path
};

/// Which actions of an instance the eyes' pose drives. Pure bookkeeping of what the application
/// declared; the runtime has checked it.
class EyeBindings {
  public:
    void add_set(XrActionSet set, std::uint32_t priority) { priorities_[set] = priority; }
    void remove_set(XrActionSet set);

    /// `eyes`: the eyes' path is among those that the action was declared for.
    void add_action(XrAction action, XrActionSet set, bool eyes) { actions_[action] = {set, eyes}; }
    void remove_action(XrAction action) { actions_.erase(action); }
    [[nodiscard]] bool knows(XrAction action) const { return actions_.contains(action); }
    [[nodiscard]] bool declares_eyes(XrAction action) const;
    /// Whether it belongs to one of these sets.
    [[nodiscard]] bool is_in(XrAction action, std::span<const XrActionSet> sets) const;

    /// What is suggested for the eye gaze profile; replaces what was before.
    void suggest(std::span<const XrAction> actions);
    /// Whether the eyes would drive it.
    [[nodiscard]] bool is_bound(XrAction action) const;

    /// Whether any action of these sets is bound.
    [[nodiscard]] bool binds_any(std::span<const XrActionSet> sets) const;

    /// Those that the eyes drive while these sets are synchronized, into `active`: of several sets
    /// the ones with the highest priority. No memory is allocated once `active` has had room for
    /// all.
    void active(std::span<const SyncedSet> synced, std::vector<XrAction>& active) const;

  private:
    struct Declared {
        XrActionSet set = XR_NULL_HANDLE;
        bool eyes = false;
    };

    [[nodiscard]] XrActionSet set_of(XrAction action) const;

    std::unordered_map<XrActionSet, std::uint32_t> priorities_;
    std::unordered_map<XrAction, Declared> actions_;
    std::vector<XrAction> suggested_;
};

}  // namespace gazeloop::openxr_layer
