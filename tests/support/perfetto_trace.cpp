#include "tests/support/perfetto_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <protozero/pbf_reader.hpp>
#include <set>

namespace gazeloop::tests {
namespace {

using protozero::pbf_reader;

struct Event {
    std::int64_t ns = 0;
    std::uint64_t track = 0;
    std::int32_t type = 0;
    std::string name;
    double value = 0.0;
    bool has_value = false;
    std::map<std::string, std::string> annotations;
    std::vector<std::uint64_t> flows;
    bool ends_flow = false;
};

constexpr std::int32_t kBegin = 1;
constexpr std::int32_t kEnd = 2;
constexpr std::int32_t kInstant = 3;
constexpr std::int32_t kCounter = 4;

class Reader {
  public:
    PerfettoTrace read(std::string_view bytes) {
        try {
            pbf_reader trace(bytes.data(), bytes.size());
            while (trace.next()) {
                if (trace.tag() == 1) {
                    read_packet(trace.get_message());
                } else {
                    fault("a field that is no packet");
                    trace.skip();
                }
            }
        } catch (const protozero::exception& error) {
            fault(fmt::format("no protobuf: {}", error.what()));
        }
        // Readers sort by time; of one time the order of the file stays.
        std::ranges::stable_sort(events_, {}, &Event::ns);
        for (const Event& event : events_) {
            take(event);
        }
        for (const auto& [track, open] : open_) {
            if (!open.empty()) {
                fault("a slice without an end on " + name_of(track));
            }
        }
        check_flows();
        trace_.faults.assign(faults_.begin(), faults_.end());
        return std::move(trace_);
    }

  private:
    void fault(const std::string& text) { faults_.insert(text); }
    std::string name_of(std::uint64_t track) { return trace_.tracks[track].name; }

    void read_packet(pbf_reader packet) {
        ++trace_.packets;
        std::optional<std::uint64_t> timestamp;
        std::uint32_t sequence = 0;
        std::uint32_t flags = 0;
        bool first = false;
        std::optional<pbf_reader> event;
        std::optional<pbf_reader> interned;
        std::optional<pbf_reader> track;
        while (packet.next()) {
            switch (packet.tag()) {
                case 6:
                    read_clock_snapshot(packet.get_message());
                    break;
                case 8:
                    timestamp = packet.get_uint64();
                    break;
                case 10:
                    sequence = packet.get_uint32();
                    break;
                case 11:
                    event = packet.get_message();
                    break;
                case 12:
                    interned = packet.get_message();
                    break;
                case 13:
                    flags = packet.get_uint32();
                    break;
                case 59:
                    read_defaults(packet.get_message());
                    break;
                case 60:
                    track = packet.get_message();
                    break;
                case 87:
                    first = packet.get_bool();
                    break;
                default:
                    fault(fmt::format("a packet's field {}", packet.tag()));
                    packet.skip();
            }
        }
        if (sequence == 0) {
            fault("a packet without a sequence");
        }
        if ((flags & 1U) != 0) {
            interned_.clear();
            cleared_ = true;
        }
        if (first != (trace_.packets == 1) || ((flags & 1U) != 0) != (trace_.packets == 1)) {
            fault("the sequence is not cleared by its first packet, and by it alone");
        }
        if ((interned || event || track) && ((flags & 2U) == 0 || !cleared_)) {
            fault("a packet that needs the sequence's state without saying so, or before it");
        }
        if (interned) {
            read_interned(*interned);
        }
        if (track) {
            read_track(*track);
        }
        if (event) {
            if (!timestamp) {
                fault("an event without a time");
            }
            read_event(*event, timestamp.value_or(0));
        }
    }

    void read_clock_snapshot(pbf_reader snapshot) {
        while (snapshot.next()) {
            if (snapshot.tag() == 2) {
                trace_.clock = static_cast<std::uint64_t>(snapshot.get_enum());
                continue;
            }
            pbf_reader clock = snapshot.get_message();
            while (clock.next()) {
                if (clock.tag() == 1) {
                    snapshot_clock_ = clock.get_uint32();
                } else {
                    trace_.clock_reading_ns = static_cast<std::int64_t>(clock.get_uint64());
                }
            }
        }
        if (trace_.packets != 1 || snapshot_clock_ != trace_.clock) {
            fault("a clock's snapshot that is not first, or of another clock than the trace");
        }
    }

    void read_defaults(pbf_reader defaults) {
        while (defaults.next()) {
            if (defaults.tag() == 58) {
                default_clock_ = defaults.get_uint32();
            } else {
                defaults.skip();
            }
        }
    }

    void read_interned(pbf_reader data) {
        while (data.next()) {
            const std::uint32_t table = data.tag();
            pbf_reader entry = data.get_message();
            std::uint64_t iid = 0;
            std::string text;
            while (entry.next()) {
                if (entry.tag() == 1) {
                    iid = entry.get_uint64();
                } else {
                    text = entry.get_string();
                }
            }
            if (iid == 0 || !interned_[table].emplace(iid, text).second) {
                fault("a number of a text that is 0, or given twice");
            }
        }
    }

    std::string text_of(std::uint32_t table, std::uint64_t iid) {
        const auto& texts = interned_[table];
        const auto found = texts.find(iid);
        if (found == texts.end()) {
            fault(fmt::format("text {} of table {} is used before it is given", iid, table));
            return {};
        }
        return found->second;
    }

    void read_track(pbf_reader fields) {
        std::uint64_t id = 0;
        PerfettoTrace::Track track;
        while (fields.next()) {
            switch (fields.tag()) {
                case 1:
                    id = fields.get_uint64();
                    break;
                case 2:
                    track.name = fields.get_string();
                    break;
                case 5:
                    track.parent = fields.get_uint64();
                    break;
                case 8: {
                    pbf_reader counter = fields.get_message();
                    while (counter.next()) {
                        track.unit = counter.tag() == 6 ? counter.get_string() : track.unit;
                    }
                    break;
                }
                default:
                    fields.skip();
            }
        }
        if (track.parent != 0 && !trace_.tracks.contains(track.parent)) {
            fault("a track whose parent is unknown");
        }
        for (const auto& [other, known] : trace_.tracks) {
            if (known.parent == track.parent && known.name == track.name) {
                fault("neighbouring tracks of one name, which readers merge");
            }
        }
        if (id == 0 || !trace_.tracks.emplace(id, track).second) {
            fault("a track's number that is 0, or given twice");
        }
    }

    void read_event(pbf_reader fields, std::uint64_t timestamp) {
        Event event;
        event.ns = static_cast<std::int64_t>(timestamp);
        if (event.ns < 0 || event.ns >= std::int64_t{1} << 62) {
            fault("a time that readers drop");
        }
        while (fields.next()) {
            switch (fields.tag()) {
                case 4:
                    read_annotation(fields.get_message(), event);
                    break;
                case 9:
                    event.type = fields.get_enum();
                    break;
                case 10:
                    event.name = text_of(2, fields.get_uint64());
                    break;
                case 11:
                    event.track = fields.get_uint64();
                    break;
                case 23:
                    event.name = fields.get_string();
                    break;
                case 44:
                    event.value = fields.get_double();
                    event.has_value = true;
                    break;
                case 47:
                    event.flows.push_back(fields.get_fixed64());
                    break;
                case 48:
                    event.flows.push_back(fields.get_fixed64());
                    event.ends_flow = true;
                    break;
                default:
                    fault(fmt::format("an event's field {}", fields.tag()));
                    fields.skip();
            }
        }
        const auto track = trace_.tracks.find(event.track);
        if (track == trace_.tracks.end()) {
            fault("an event on a track that is not described before it");
        } else if ((event.type == kCounter) == track->second.unit.empty() ||
                   event.has_value != (event.type == kCounter)) {
            fault("a counter's event on another track, or without a value");
        }
        if (event.type != kEnd && event.type != kCounter && event.name.empty()) {
            fault("an event without a name");
        }
        // Written in the order of their times, as the format asks of one track's slices.
        if (event.type == kBegin || event.type == kEnd) {
            std::int64_t& last_ns = last_ns_.try_emplace(event.track, event.ns).first->second;
            if (event.ns < last_ns) {
                fault("times that go back on " + name_of(event.track));
            }
            last_ns = event.ns;
        }
        events_.push_back(std::move(event));
    }

    void read_annotation(pbf_reader fields, Event& event) {
        std::string key;
        std::string value;
        while (fields.next()) {
            switch (fields.tag()) {
                case 1:
                    key = text_of(3, fields.get_uint64());
                    break;
                case 3:
                    value = fmt::format("{}", fields.get_uint64());
                    break;
                case 5:
                    value = fmt::format("{}", fields.get_double());
                    break;
                case 6:
                    value = fields.get_string();
                    break;
                case 17:
                    value = text_of(29, fields.get_uint64());
                    break;
                default:
                    fault(fmt::format("an annotation's field {}", fields.tag()));
                    fields.skip();
            }
        }
        if (key.empty() || !event.annotations.emplace(key, value).second) {
            fault("an annotation without a name, or twice");
        }
    }

    /// In the order of the times.
    void take(const Event& event) {
        if (event.type == kCounter) {
            trace_.counts.push_back({name_of(event.track), event.ns, event.value});
            return;
        }
        auto& open = open_[event.track];
        if (event.type == kEnd) {
            if (open.empty()) {
                fault("an end without a begin on " + name_of(event.track));
                return;
            }
            trace_.slices[open.back()].end_ns = event.ns;
            open.pop_back();
            return;
        }
        if (event.type != kBegin && event.type != kInstant) {
            fault(fmt::format("an event of type {}", event.type));
            return;
        }
        trace_.slices.push_back({.track = name_of(event.track),
                                 .track_id = event.track,
                                 .name = event.name,
                                 .begin_ns = event.ns,
                                 .end_ns = event.ns,
                                 .depth = open.size(),
                                 .instant = event.type == kInstant,
                                 .annotations = event.annotations,
                                 .flows = event.flows,
                                 .ends_flow = event.ends_flow});
        if (event.type == kBegin) {
            open.push_back(trace_.slices.size() - 1);
        }
    }

    void check_flows() {
        std::map<std::uint64_t, std::vector<const PerfettoTrace::Slice*>> flows;
        for (const PerfettoTrace::Slice& slice : trace_.slices) {
            for (const std::uint64_t id : slice.flows) {
                flows[id].push_back(&slice);
            }
        }
        for (const auto& [id, slices] : flows) {
            if (slices.size() < 2) {
                fault("a flow of one event");
            }
            for (const PerfettoTrace::Slice* const slice : slices) {
                if (slice->ends_flow != (slice == slices.back())) {
                    fault("a flow that does not end with its last event");
                }
            }
        }
        if (default_clock_ != trace_.clock) {
            fault("packets of another clock than the trace's");
        }
    }

    PerfettoTrace trace_;
    std::set<std::string> faults_;
    bool cleared_ = false;
    std::optional<std::uint64_t> snapshot_clock_;
    std::optional<std::uint64_t> default_clock_;
    std::map<std::uint32_t, std::map<std::uint64_t, std::string>> interned_;
    std::vector<Event> events_;
    std::map<std::uint64_t, std::int64_t> last_ns_;
    std::map<std::uint64_t, std::vector<std::size_t>> open_;
};

template <typename T, typename Wanted>
std::vector<T> those(const std::vector<T>& all, const Wanted& wanted) {
    std::vector<T> some;
    std::ranges::copy_if(all, std::back_inserter(some), wanted);
    return some;
}

}  // namespace

std::vector<PerfettoTrace::Slice> PerfettoTrace::on(std::string_view track) const {
    return those(slices, [track](const Slice& slice) { return slice.track == track; });
}

std::vector<PerfettoTrace::Slice> PerfettoTrace::named(std::string_view name) const {
    return those(slices, [name](const Slice& slice) { return slice.name == name; });
}

std::vector<PerfettoTrace::Count> PerfettoTrace::counted(std::string_view track) const {
    return those(counts, [track](const Count& count) { return count.track == track; });
}

std::vector<PerfettoTrace::Slice> PerfettoTrace::flow(std::uint64_t id) const {
    return those(slices,
                 [id](const Slice& slice) { return std::ranges::count(slice.flows, id) > 0; });
}

PerfettoTrace read_perfetto(std::string_view bytes) { return Reader().read(bytes); }

}  // namespace gazeloop::tests
