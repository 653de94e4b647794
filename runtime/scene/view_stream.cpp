#include "runtime/scene/view_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/error.h"

namespace gazeloop::scene {

ViewStream::ViewStream(const vulkan::Context& context, const vulkan::LayeredImage& image,
                       memory::ScratchFile file, std::uint32_t views, std::uint64_t view_bytes,
                       const LightFieldStorage& storage)
    : image_(image),
      view_bytes_(view_bytes),
      storage_(storage),
      views_(views),
      file_(std::move(file)),
      staging_(context, (storage.staged + storage.ahead) * view_bytes,
               vk::BufferUsageFlagBits::eTransferSrc),
      resident_(views, storage.layers),
      places_(storage.staged + storage.ahead),
      uploads_(context) {
    if (storage.ahead > 0) {
        thread_.emplace(file_, storage.staged + storage.ahead);
    }
}

void ViewStream::bring(std::span<const std::uint32_t> wanted) {
    const auto loads = resident_.request(wanted);
    for (const light_field::ResidentViews::Load& load : loads) {
        read(load);
    }
    const std::uint64_t late = collect();
    submit_staged();
    waits_.frames += loads.empty() ? 0 : 1;
    waits_.views += loads.size();
    waits_.most_in_a_frame = std::max<std::uint64_t>(waits_.most_in_a_frame, loads.size());
    waits_.late_frames += late > 0 ? 1 : 0;
    waits_.late_views += late;
}

void ViewStream::fetch_ahead(std::span<const std::uint32_t> likely) {
    if (!thread_) {
        return;
    }
    for (const light_field::ResidentViews::Load& load :
         resident_.fetch_ahead(likely, storage_.ahead)) {
        on_their_way_.push_back({load});
    }
    drop_what_went();
    begin_to_read();
}

/// Gives the thread what may be read: no more at a time than leaves frames the places of their own.
void ViewStream::begin_to_read() {
    auto reading = static_cast<std::uint32_t>(std::ranges::count_if(
        on_their_way_, [](const OnItsWay& one) { return one.place.has_value(); }));
    for (OnItsWay& one : on_their_way_) {
        if (one.place || one.unreadable) {
            continue;
        }
        const std::uint32_t place = oldest_place();
        if (reading == storage_.ahead || !uploads_.is_done(places_[place].upload)) {
            return;
        }
        places_[place].taken = true;
        one.place = place;
        thread_->ask(place, one.load.view * view_bytes_, memory_of(place));
        ++reading;
    }
}

/// Forgets the views whose layers were given to others, once nobody reads them any more.
void ViewStream::drop_what_went() {
    for (std::size_t i = on_their_way_.size(); i-- > 0;) {
        OnItsWay& one = on_their_way_[i];
        const auto& [view, layer] = one.load;
        one.gone = one.gone || !resident_.is_resident(view) || resident_.layer_of(view) != layer;
        if (one.gone && (!one.place || thread_->take_back(*one.place))) {
            if (one.place) {
                places_[*one.place].taken = false;
            }
            on_their_way_.erase(on_their_way_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

/// Takes from the thread what it has read, and all that is wanted now; returns how many of these
/// were not there yet. What it has not begun is read here meanwhile: from the last, which it would
/// come to last.
std::uint64_t ViewStream::collect() {
    using State = memory::ReadAhead::State;
    drop_what_went();
    std::uint64_t late = 0;
    for (std::size_t i = on_their_way_.size(); i-- > 0;) {
        OnItsWay& one = on_their_way_[i];
        const bool wanted = !one.gone && resident_.is_wanted(one.load.view);
        bool staged = false;
        if (one.place) {
            const State state = thread_->state(*one.place);
            const bool here = state == State::Read || state == State::Failed;
            if (!here && !wanted) {
                continue;
            }
            late += here ? 0 : 1;
            const std::uint32_t place = *std::exchange(one.place, std::nullopt);
            const bool read = !thread_->take_back(place) && thread_->take(place);
            places_[place].taken = false;
            one.unreadable = here && !read;
            staged = read && !one.gone;
            if (staged) {
                stage(one.load.layer, place);
            }
        } else {
            late += wanted ? 1 : 0;
        }
        if (wanted && !staged) {
            read(one.load);
        }
        if (wanted || staged || one.gone) {
            on_their_way_.erase(on_their_way_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
    return late;
}

void ViewStream::read(const light_field::ResidentViews::Load& load) {
    const std::uint32_t place = free_place();
    value_or_throw(file_.read(load.view * view_bytes_, memory_of(place)));
    stage(load.layer, place);
}

void ViewStream::stage(std::uint32_t layer, std::uint32_t place) {
    places_[place].taken = true;
    staged_.push_back({layer, place * view_bytes_});
}

void ViewStream::submit_staged() {
    if (staged_.empty()) {
        return;
    }
    const std::uint64_t upload = uploads_.submit(image_, staging_.buffer(), staged_);
    for (const vulkan::LayerSource& one : staged_) {
        places_[one.offset / view_bytes_] = {.upload = upload, .taken = false};
    }
    staged_.clear();
}

/// Of those that are not taken, the one that the device is done with first. Precondition: there is
/// one.
std::uint32_t ViewStream::oldest_place() const {
    const auto oldest = std::ranges::min_element(places_, {}, [](const Place& place) {
        return place.taken ? std::numeric_limits<std::uint64_t>::max() : place.upload;
    });
    return static_cast<std::uint32_t>(oldest - places_.begin());
}

/// One to read into. Frames have some of their own, which are free once they are copied from.
std::uint32_t ViewStream::free_place() {
    if (std::ranges::all_of(places_, &Place::taken)) {
        submit_staged();
    }
    const std::uint32_t place = oldest_place();
    if (!uploads_.is_done(places_[place].upload)) {
        submit_staged();  // the device may as well begin
        uploads_.wait(places_[place].upload);
    }
    return place;
}

std::string ViewStream::account() const {
    std::string text = fmt::format("{} frames waited for {} views, none for more than {}",
                                   waits_.frames, waits_.views, waits_.most_in_a_frame);
    if (thread_) {
        text += fmt::format("; {} views were fetched ahead, {} of them asked for",
                            resident_.fetched(), resident_.fetched_and_wanted());
    }
    if (waits_.late_views > 0) {
        text +=
            fmt::format(", {} of these late, in {} frames", waits_.late_views, waits_.late_frames);
    }
    return text;
}

}  // namespace gazeloop::scene
