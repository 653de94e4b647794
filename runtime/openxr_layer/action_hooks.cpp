// Actions that the eyes drive. Where the layer provides eye gaze, the runtime below never hears of
// the eyes' path: it may not know it. It checks everything else, and is asked first.
#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "runtime/openxr_layer/hook.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

XrResult create_action_set(Call<&Next::CreateActionSet>& call, XrInstance instance,
                           const XrActionSetCreateInfo* info, XrActionSet* set) {
    const XrResult result = call.down(instance, info, set);
    if (XR_SUCCEEDED(result)) {
        Instances::all().add_child(*set, call.pointer(), XR_NULL_HANDLE);
        const std::lock_guard lock(call.instance().mutex);
        call.instance().bindings.add_set(*set, info->priority);
    }
    return result;
}

XrResult destroy_action_set(Call<&Next::DestroyActionSet>& call, XrActionSet set) {
    {
        const std::lock_guard lock(call.instance().mutex);
        call.instance().bindings.remove_set(set);
    }
    Instances::all().remove_child(set);
    return call.down(set);
}

XrResult create_action(Call<&Next::CreateAction>& call, XrActionSet set,
                       const XrActionCreateInfo* info, XrAction* action) {
    const LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || info == nullptr || info->subactionPaths == nullptr) {
        const XrResult result = call.down(set, info, action);
        if (XR_SUCCEEDED(result)) {
            Instances::all().add_child(*action, call.pointer(), XR_NULL_HANDLE);
            const std::lock_guard lock(call.instance().mutex);
            call.instance().bindings.add_action(*action, set, false);
        }
        return result;
    }
    std::vector<XrPath> paths(info->subactionPaths,
                              info->subactionPaths + info->countSubactionPaths);
    const auto eyes = std::erase(paths, layered.eyes);
    if (eyes > 1) {
        return XR_ERROR_PATH_UNSUPPORTED;  // given twice
    }
    XrActionCreateInfo passed_on = *info;
    passed_on.countSubactionPaths = static_cast<std::uint32_t>(paths.size());
    passed_on.subactionPaths = paths.empty() ? nullptr : paths.data();
    const XrActionCreateInfo* const passed = &passed_on;
    const XrResult result = call.down(set, passed, action);
    if (XR_SUCCEEDED(result)) {
        Instances::all().add_child(*action, call.pointer(), XR_NULL_HANDLE);
        const std::lock_guard lock(call.instance().mutex);
        call.instance().bindings.add_action(*action, set, eyes == 1);
    }
    return result;
}

XrResult destroy_action(Call<&Next::DestroyAction>& call, XrAction action) {
    {
        const std::lock_guard lock(call.instance().mutex);
        call.instance().bindings.remove_action(action);
    }
    Instances::all().remove_child(action);
    return call.down(action);
}

/// For the eye gaze profile the layer answers alone: since 1.1.60 its bindings are to be accepted
/// whether or not there are eyes to look at.
XrResult suggest_bindings(Call<&Next::SuggestInteractionProfileBindings>& call, XrInstance instance,
                          const XrInteractionProfileSuggestedBinding* suggested) {
    LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || suggested == nullptr ||
        suggested->interactionProfile != layered.profile || layered.profile == XR_NULL_PATH) {
        return call.down(instance, suggested);
    }
    if (suggested->type != XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING ||
        suggested->countSuggestedBindings == 0 || suggested->suggestedBindings == nullptr) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const std::span bindings(suggested->suggestedBindings, suggested->countSuggestedBindings);
    std::vector<XrAction> actions;
    const std::lock_guard lock(layered.mutex);
    for (const XrActionSuggestedBinding& binding : bindings) {
        if (binding.binding != layered.gaze_pose) {
            return XR_ERROR_PATH_UNSUPPORTED;
        }
        if (!layered.bindings.knows(binding.action)) {
            return XR_ERROR_HANDLE_INVALID;
        }
        const bool attached = std::ranges::any_of(layered.sessions, [&](const auto& one) {
            return layered.bindings.is_in(binding.action, one.second.attached);
        });
        if (attached) {
            return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
        }
        actions.push_back(binding.action);
    }
    layered.bindings.suggest(actions);
    return XR_SUCCESS;
}

XrResult attach(Call<&Next::AttachSessionActionSets>& call, XrSession session,
                const XrSessionActionSetsAttachInfo* info) {
    const XrResult result = call.down(session, info);
    if (XR_SUCCEEDED(result)) {
        const std::lock_guard lock(call.instance().mutex);
        if (LayeredSession* const known = call.instance().session(session)) {
            known->attached.assign(info->actionSets, info->actionSets + info->countActionSets);
        }
    }
    return result;
}

void tell_profile_changed(LayeredInstance& layered, XrSession session) {
    XrEventDataInteractionProfileChanged changed{};
    changed.type = XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
    changed.session = session;
    XrEventDataBuffer buffer{};
    static_assert(sizeof changed <= sizeof buffer);
    std::memcpy(&buffer, &changed, sizeof changed);
    layered.events.push_back(buffer);
}

/// What the eyes drive from now on: nothing without focus, gaze or leave.
void follow_sync(LayeredInstance& layered, LayeredSession& session, XrResult result) {
    session.active.clear();
    if (result != XR_SUCCESS && result != XR_SESSION_LOSS_PENDING) {
        return;
    }
    if (!session.profile_told && layered.bindings.binds_any(session.attached)) {
        session.profile_told = true;
        tell_profile_changed(layered, session.handle);
    }
    const std::int64_t now_ns = time::monotonic_ns();
    layered.bindings.active(session.synced, session.active);
    if (!session.active.empty() &&
        (session.feed == nullptr || !layered.permits_gaze() || !session.feed->tracks(now_ns))) {
        session.active.clear();
    }
}

/// What the runtime is to hear of synchronized sets, in memory of its own unless they are many.
class PassedSets {
  public:
    PassedSets(std::span<const XrActiveActionSet> sets, XrPath eyes) {
        if (sets.size() > few_.size()) {
            many_.resize(sets.size());
        }
        for (const XrActiveActionSet& set : sets) {
            if (set.subactionPath != eyes) {
                data()[count_++] = set;
            }
        }
        if (count_ > 0) {
            return;
        }
        // Synchronized for the eyes alone they still go down, or nobody would check them.
        for (const XrActiveActionSet& set : sets) {
            data()[count_++] = {set.actionSet, XR_NULL_PATH};
        }
    }
    [[nodiscard]] XrActiveActionSet* data() { return many_.empty() ? few_.data() : many_.data(); }
    [[nodiscard]] std::uint32_t count() const { return count_; }

  private:
    std::array<XrActiveActionSet, 32> few_{};
    std::vector<XrActiveActionSet> many_;
    std::uint32_t count_ = 0;
};

XrResult sync_actions(Call<&Next::SyncActions>& call, XrSession session,
                      const XrActionsSyncInfo* info) {
    LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || info == nullptr) {
        return call.down(session, info);
    }
    const std::span sets(info->activeActionSets,
                         info->activeActionSets != nullptr ? info->countActiveActionSets : 0);
    PassedSets passed_sets(sets, layered.eyes);
    XrActionsSyncInfo passed_on = *info;
    if (!sets.empty()) {
        passed_on.countActiveActionSets = passed_sets.count();
        passed_on.activeActionSets = passed_sets.data();
    }
    const XrActionsSyncInfo* const passed = &passed_on;
    const XrResult result = call.down(session, passed);
    const std::lock_guard lock(layered.mutex);
    LayeredSession* const known = layered.session(session);
    if (known != nullptr && XR_SUCCEEDED(result)) {
        known->synced.clear();
        for (const XrActiveActionSet& set : sets) {
            known->synced.push_back({set.actionSet, set.subactionPath == XR_NULL_PATH ||
                                                        set.subactionPath == layered.eyes});
        }
    }
    if (known != nullptr) {
        follow_sync(layered, *known, result);
    }
    return result;
}

XrResult get_state(Call<&Next::GetActionStatePose>& call, XrSession session,
                   const XrActionStateGetInfo* info, XrActionStatePose* state) {
    LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || info == nullptr || state == nullptr) {
        return call.down(session, info, state);
    }
    const bool for_eyes = info->subactionPath == layered.eyes;
    XrActionStateGetInfo passed_on = *info;
    bool active = false;
    {
        const std::lock_guard lock(layered.mutex);
        const LayeredSession* const known = layered.session(session);
        if (for_eyes && !layered.bindings.declares_eyes(info->action)) {
            return XR_ERROR_PATH_UNSUPPORTED;
        }
        active = known != nullptr && (for_eyes || info->subactionPath == XR_NULL_PATH) &&
                 std::ranges::find(known->active, info->action) != known->active.end();
    }
    passed_on.subactionPath = for_eyes ? XR_NULL_PATH : info->subactionPath;
    const XrActionStateGetInfo* const passed = &passed_on;
    const XrResult result = call.down(session, passed, state);
    if (XR_SUCCEEDED(result)) {
        state->isActive = active ? XR_TRUE : for_eyes ? XR_FALSE : state->isActive;
    }
    return result;
}

XrResult get_profile(Call<&Next::GetCurrentInteractionProfile>& call, XrSession session,
                     XrPath user, XrInteractionProfileState* state) {
    LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || user != layered.eyes || state == nullptr) {
        return call.down(session, user, state);
    }
    const std::lock_guard lock(layered.mutex);
    const LayeredSession* const known = layered.session(session);
    if (known == nullptr) {
        return XR_ERROR_HANDLE_INVALID;
    }
    if (state->type != XR_TYPE_INTERACTION_PROFILE_STATE) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    if (known->attached.empty()) {
        return XR_ERROR_ACTIONSET_NOT_ATTACHED;
    }
    state->interactionProfile = known->profile_told ? layered.profile : XR_NULL_PATH;
    return XR_SUCCESS;
}

/// The runtime's sources, and the eyes after them.
XrResult bound_sources(Call<&Next::EnumerateBoundSourcesForAction>& call, XrSession session,
                       const XrBoundSourcesForActionEnumerateInfo* info, std::uint32_t capacity,
                       std::uint32_t* count, XrPath* sources) {
    LayeredInstance& layered = call.instance();
    bool bound = false;
    if (layered.provides_eye_gaze() && info != nullptr && count != nullptr) {
        const std::lock_guard lock(layered.mutex);
        const LayeredSession* const known = layered.session(session);
        bound = known != nullptr && known->profile_told && layered.bindings.is_bound(info->action);
    }
    if (!bound) {
        return call.down(session, info, capacity, count, sources);
    }
    XrPath* const none = nullptr;
    const std::uint32_t zero = 0;
    if (const XrResult result = call.down(session, info, zero, count, none); XR_FAILED(result)) {
        return result;
    }
    const std::uint32_t below = *count;
    *count = below + 1;
    if (capacity == 0) {
        return XR_SUCCESS;
    }
    if (capacity < below + 1 || sources == nullptr) {
        return XR_ERROR_SIZE_INSUFFICIENT;
    }
    std::uint32_t written = 0;
    if (below > 0) {
        const XrResult result = call.down(session, info, below, &written, sources);
        if (XR_FAILED(result)) {
            return result;
        }
    }
    sources[written] = layered.gaze_pose;
    *count = written + 1;
    return XR_SUCCESS;
}

XrResult source_name(Call<&Next::GetInputSourceLocalizedName>& call, XrSession session,
                     const XrInputSourceLocalizedNameGetInfo* info, std::uint32_t capacity,
                     std::uint32_t* count, char* buffer) {
    const LayeredInstance& layered = call.instance();
    if (!layered.provides_eye_gaze() || info == nullptr || count == nullptr ||
        info->sourcePath != layered.gaze_pose) {
        return call.down(session, info, capacity, count, buffer);
    }
    if (info->whichComponents == 0) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    std::string name;
    for (const auto& [component, text] :
         {std::pair{XR_INPUT_SOURCE_LOCALIZED_NAME_USER_PATH_BIT, "Eyes"},
          {XR_INPUT_SOURCE_LOCALIZED_NAME_INTERACTION_PROFILE_BIT, "Eye tracker"},
          {XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT, "Gaze"}}) {
        if ((info->whichComponents & component) != 0) {
            name.append(name.empty() ? "" : " ").append(text);
        }
    }
    *count = static_cast<std::uint32_t>(name.size() + 1);
    if (capacity == 0) {
        return XR_SUCCESS;
    }
    if (capacity < *count || buffer == nullptr) {
        return XR_ERROR_SIZE_INSUFFICIENT;
    }
    std::memcpy(buffer, name.c_str(), name.size() + 1);
    return XR_SUCCESS;
}

}  // namespace

std::span<const Hook> action_hooks() {
    static const std::array kHooks{
        hook<&Next::CreateActionSet, &create_action_set>("xrCreateActionSet"),
        hook<&Next::DestroyActionSet, &destroy_action_set>("xrDestroyActionSet"),
        hook<&Next::CreateAction, &create_action>("xrCreateAction"),
        hook<&Next::DestroyAction, &destroy_action>("xrDestroyAction"),
        hook<&Next::SuggestInteractionProfileBindings, &suggest_bindings>(
            "xrSuggestInteractionProfileBindings"),
        hook<&Next::AttachSessionActionSets, &attach>("xrAttachSessionActionSets"),
        hook<&Next::SyncActions, &sync_actions>("xrSyncActions"),
        hook<&Next::GetActionStatePose, &get_state>("xrGetActionStatePose"),
        hook<&Next::GetCurrentInteractionProfile, &get_profile>("xrGetCurrentInteractionProfile"),
        hook<&Next::EnumerateBoundSourcesForAction, &bound_sources>(
            "xrEnumerateBoundSourcesForAction"),
        hook<&Next::GetInputSourceLocalizedName, &source_name>("xrGetInputSourceLocalizedName"),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
