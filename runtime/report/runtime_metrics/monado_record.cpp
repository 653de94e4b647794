#include "runtime/report/runtime_metrics/monado_record.h"

#include <limits>
#include <protozero/pbf_message.hpp>

namespace gazeloop::report {
namespace {

// Numbers of the fields.
enum class RecordField : protozero::pbf_tag_type {
    Version = 1,
    SessionFrame = 2,
    Used = 3,
    SystemFrame = 4,
    GpuInfo = 5,
    PresentInfo = 6,
};
enum class VersionField : protozero::pbf_tag_type { Major = 1, Minor = 2 };
enum class SessionFrameField : protozero::pbf_tag_type {
    Session = 1,
    Frame = 2,
    PredictedDisplay = 6,
    Begin = 11,
    GpuDone = 13,
    Discarded = 14,
};
enum class UsedField : protozero::pbf_tag_type {
    Session = 1,
    SessionFrame = 2,
    SystemFrame = 3,
    When = 4
};
enum class SystemFrameField : protozero::pbf_tag_type {
    Frame = 1,
    PredictedDisplay = 2,
    DesiredPresent = 4
};
enum class GpuInfoField : protozero::pbf_tag_type { Frame = 1, End = 3, When = 4 };
enum class PresentInfoField : protozero::pbf_tag_type {
    Frame = 1,
    PredictedDisplay = 5,
    Infoed = 10,
    DesiredPresent = 11,
    ActualPresent = 14,
};

/// The fields that are read are all varints. Asked for before a value is taken: protozero only
/// asserts it.
template <typename Message>
std::uint64_t varint(Message& message) {
    if (!message.has_wire_type(protozero::pbf_wire_type::varint)) {
        throw protozero::unknown_pbf_wire_type_exception{};
    }
    return message.get_uint64();
}

template <typename Message>
std::int64_t number(Message& message) {
    return static_cast<std::int64_t>(varint(message));
}

template <typename Message>
std::int64_t time_ns(Message& message) {
    const std::uint64_t ns = varint(message);
    return ns <= std::numeric_limits<std::int64_t>::max() ? static_cast<std::int64_t>(ns) : 0;
}

MonadoRecord read(protozero::pbf_message<VersionField> message) {
    MonadoVersion version;
    while (message.next()) {
        switch (message.tag()) {
            case VersionField::Major:
                version.major = static_cast<std::uint32_t>(varint(message));
                break;
            case VersionField::Minor:
                version.minor = static_cast<std::uint32_t>(varint(message));
                break;
            default:
                message.skip();
        }
    }
    return version;
}

MonadoRecord read(protozero::pbf_message<SessionFrameField> message) {
    MonadoSessionFrame frame;
    while (message.next()) {
        switch (message.tag()) {
            case SessionFrameField::Session:
                frame.session = number(message);
                break;
            case SessionFrameField::Frame:
                frame.frame = number(message);
                break;
            case SessionFrameField::PredictedDisplay:
                frame.predicted_display_ns = time_ns(message);
                break;
            case SessionFrameField::Begin:
                frame.begin_ns = time_ns(message);
                break;
            case SessionFrameField::GpuDone:
                frame.gpu_done_ns = time_ns(message);
                break;
            case SessionFrameField::Discarded:
                frame.discarded = varint(message) != 0;
                break;
            default:
                message.skip();
        }
    }
    return frame;
}

MonadoRecord read(protozero::pbf_message<UsedField> message) {
    MonadoUsed used;
    while (message.next()) {
        switch (message.tag()) {
            case UsedField::Session:
                used.session = number(message);
                break;
            case UsedField::SessionFrame:
                used.session_frame = number(message);
                break;
            case UsedField::SystemFrame:
                used.system_frame = number(message);
                break;
            case UsedField::When:
                used.when_ns = time_ns(message);
                break;
            default:
                message.skip();
        }
    }
    return used;
}

MonadoRecord read(protozero::pbf_message<SystemFrameField> message) {
    MonadoSystemFrame frame;
    while (message.next()) {
        switch (message.tag()) {
            case SystemFrameField::Frame:
                frame.frame = number(message);
                break;
            case SystemFrameField::PredictedDisplay:
                frame.predicted_display_ns = time_ns(message);
                break;
            case SystemFrameField::DesiredPresent:
                frame.desired_present_ns = time_ns(message);
                break;
            default:
                message.skip();
        }
    }
    return frame;
}

MonadoRecord read(protozero::pbf_message<GpuInfoField> message) {
    MonadoGpuInfo info;
    while (message.next()) {
        switch (message.tag()) {
            case GpuInfoField::Frame:
                info.frame = number(message);
                break;
            case GpuInfoField::End:
                info.gpu_end_ns = time_ns(message);
                break;
            case GpuInfoField::When:
                info.when_ns = time_ns(message);
                break;
            default:
                message.skip();
        }
    }
    return info;
}

MonadoRecord read(protozero::pbf_message<PresentInfoField> message) {
    MonadoPresentInfo info;
    while (message.next()) {
        switch (message.tag()) {
            case PresentInfoField::Frame:
                info.frame = number(message);
                break;
            case PresentInfoField::PredictedDisplay:
                info.predicted_display_ns = time_ns(message);
                break;
            case PresentInfoField::Infoed:
                info.when_ns = time_ns(message);
                break;
            case PresentInfoField::DesiredPresent:
                info.desired_present_ns = time_ns(message);
                break;
            case PresentInfoField::ActualPresent:
                info.actual_present_ns = time_ns(message);
                break;
            default:
                message.skip();
        }
    }
    return info;
}

template <typename Field>
MonadoRecord inner(protozero::pbf_message<RecordField>& record) {
    if (!record.has_wire_type(protozero::pbf_wire_type::length_delimited)) {
        throw protozero::unknown_pbf_wire_type_exception{};
    }
    return read(protozero::pbf_message<Field>(record.get_view()));
}

}  // namespace

std::optional<MonadoRecord> monado_record(std::string_view bytes) {
    MonadoRecord result;
    try {
        protozero::pbf_message<RecordField> record(bytes.data(), bytes.size());
        while (record.next()) {
            switch (record.tag()) {
                case RecordField::Version:
                    result = inner<VersionField>(record);
                    break;
                case RecordField::SessionFrame:
                    result = inner<SessionFrameField>(record);
                    break;
                case RecordField::Used:
                    result = inner<UsedField>(record);
                    break;
                case RecordField::SystemFrame:
                    result = inner<SystemFrameField>(record);
                    break;
                case RecordField::GpuInfo:
                    result = inner<GpuInfoField>(record);
                    break;
                case RecordField::PresentInfo:
                    result = inner<PresentInfoField>(record);
                    break;
                default:
                    record.skip();
            }
        }
    } catch (const protozero::exception&) {
        return std::nullopt;
    }
    return result;
}

}  // namespace gazeloop::report
