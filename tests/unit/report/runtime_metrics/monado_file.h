#pragma once

#include <cstdint>
#include <memory>
#include <protozero/pbf_writer.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "runtime/report/runtime_metrics/monado_metrics_reader.h"

namespace gazeloop::report {

/// A metrics file as Monado 25.0.0 writes it, made field by field. As there, 0 is not written.
class MonadoFile {
  public:
    explicit MonadoFile(std::uint32_t major = 1, std::uint32_t minor = 1) {
        add(1, [&](Writer& fields) {
            fields.add_uint32(1, major);
            fields.add_uint32(2, minor);
        });
    }

    struct SessionFrame {
        std::int64_t session = 0;
        std::int64_t frame = 0;
        std::int64_t display_ns = 0;
        std::int64_t begin_ns = 0;
        std::int64_t gpu_done_ns = 0;
        bool discarded = false;
    };
    void session_frame(const SessionFrame& frame) {
        add(2, [&](Writer& fields) {
            time(fields, 1, frame.session);
            time(fields, 2, frame.frame);
            time(fields, 6, frame.display_ns);
            fields.add_uint64(7, 16'000'000);  // the period, which is not read
            time(fields, 11, frame.begin_ns);
            time(fields, 13, frame.gpu_done_ns);
            if (frame.discarded) {
                fields.add_bool(14, true);
            }
        });
    }
    void used(std::int64_t session, std::int64_t frame, std::int64_t system_frame,
              std::int64_t when_ns) {
        add(3, [&](Writer& fields) {
            time(fields, 1, session);
            time(fields, 2, frame);
            time(fields, 3, system_frame);
            time(fields, 4, when_ns);
        });
    }
    void system_frame(std::int64_t frame, std::int64_t display_ns, std::int64_t present_ns) {
        add(4, [&](Writer& fields) {
            time(fields, 1, frame);
            time(fields, 2, display_ns);
            time(fields, 4, present_ns);
        });
    }
    void gpu_info(std::int64_t frame, std::int64_t end_ns, std::int64_t when_ns) {
        add(5, [&](Writer& fields) {
            time(fields, 1, frame);
            time(fields, 3, end_ns);
            time(fields, 4, when_ns);
        });
    }
    struct PresentInfo {
        std::int64_t frame = 0;
        std::int64_t display_ns = 0;
        std::int64_t desired_ns = 0;
        std::int64_t actual_ns = 0;
        std::int64_t when_ns = 0;
    };
    void present_info(const PresentInfo& info) {
        add(6, [&](Writer& fields) {
            time(fields, 1, info.frame);
            time(fields, 5, info.display_ns);
            time(fields, 10, info.when_ns);
            time(fields, 11, info.desired_ns);
            time(fields, 14, info.actual_ns);
        });
    }

    /// A record of these bytes behind its length.
    void raw(std::string_view record) {
        protozero::add_varint_to_buffer(&bytes_, record.size());
        bytes_ += record;
    }
    /// These bytes as they are.
    void tail(std::string_view bytes) { bytes_ += bytes; }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    [[nodiscard]] Expected<MonadoMetricsReader> open() const { return open_bytes(bytes_); }
    static Expected<MonadoMetricsReader> open_bytes(const std::string& bytes) {
        return MonadoMetricsReader::open(std::make_unique<std::istringstream>(bytes), "m.pb");
    }

  private:
    using Writer = protozero::pbf_writer;

    static void time(Writer& fields, protozero::pbf_tag_type tag, std::int64_t value) {
        if (value != 0) {
            fields.add_int64(tag, value);
        }
    }
    template <typename Fill>
    void add(protozero::pbf_tag_type kind, const Fill& fill) {
        std::string record;
        Writer writer(record);
        {
            Writer fields(writer, kind);
            fill(fields);
        }
        raw(record);
    }

    std::string bytes_;
};

}  // namespace gazeloop::report
