#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "runtime/openxr_layer/layered_instance.h"

namespace gazeloop::openxr_layer {

/// The instances of the process that came through the layer, and which of them a handle belongs to.
/// What is below an instance is registered as it is made; a handle that is not (extensions make
/// spaces too) is taken for one of the newest instance, which is right wherever there is only one.
class Instances {
  public:
    using Pointer = std::shared_ptr<LayeredInstance>;

    static Instances& all();

    void add(const Pointer& instance);
    /// With all that is below it.
    void remove(XrInstance instance);

    /// `session`: what it is below of, null: of the instance alone.
    template <typename Handle>
    void add_child(Handle child, const Pointer& instance, XrSession session) {
        const std::lock_guard lock(mutex_);
        children_[key(child)] = {instance, session};
    }
    template <typename Handle>
    void remove_child(Handle child) {
        const std::lock_guard lock(mutex_);
        children_.erase(key(child));
    }
    /// All that is below a session, and the session.
    void remove_session(XrSession session);

    [[nodiscard]] Pointer of(XrInstance instance) const;
    template <typename Handle>
    [[nodiscard]] Pointer of(Handle child) const {
        return of_child(key(child));
    }
    /// The session that something was made of; null where that is not known.
    template <typename Handle>
    [[nodiscard]] XrSession session_of(Handle child) const {
        return session_of_child(key(child));
    }

  private:
    struct AtEnd;
    /// The program ends, or the library is unloaded.
    void end();

    /// Handles of different types may have the same value.
    struct Key {
        std::uint64_t number;
        std::uint64_t type;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const { return key.number * 31 + key.type; }
    };
    struct Child {
        Pointer instance;
        XrSession session;
    };

    static constexpr std::uint64_t type_of(XrSession) { return 1; }
    static constexpr std::uint64_t type_of(XrSpace) { return 2; }
    static constexpr std::uint64_t type_of(XrActionSet) { return 3; }
    static constexpr std::uint64_t type_of(XrAction) { return 4; }
    static constexpr std::uint64_t type_of(XrSwapchain) { return 5; }
    static constexpr std::uint64_t type_of(XrFoveationProfileFB) { return 6; }
    template <typename Handle>
    static Key key(Handle handle) {
        return {reinterpret_cast<std::uint64_t>(handle), type_of(handle)};
    }

    [[nodiscard]] Pointer of_child(const Key& child) const;
    [[nodiscard]] XrSession session_of_child(const Key& child) const;

    mutable std::mutex mutex_;
    std::vector<Pointer> instances_;  ///< in the order in which they were made
    std::unordered_map<Key, Child, KeyHash> children_;
};

}  // namespace gazeloop::openxr_layer
