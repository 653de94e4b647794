#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "runtime/session/record_fields.h"
#include "runtime/session/statement.h"

namespace gazeloop::session {

/// Binds the fields of a record to a statement's parameters, in order (see record_fields.h).
class FieldBinder {
  public:
    explicit FieldBinder(Statement& statement) : statement_(statement) {}

    template <typename Field>
    void operator()(std::string_view, std::string_view, const Field& field) {
        bind(field);
        ++parameter_;
    }

  private:
    void bind(double value) { statement_.bind(parameter_, value); }
    void bind(std::string_view text) { statement_.bind(parameter_, text); }
    template <std::size_t Capacity>
    void bind(const FixedText<Capacity>& text) {
        statement_.bind(parameter_, text.view());
    }
    template <typename T>
        requires(std::is_integral_v<T> || std::is_enum_v<T>)
    void bind(T value) {
        statement_.bind(parameter_, static_cast<std::int64_t>(value));
    }
    template <typename T>
    void bind(const std::optional<T>& value) {
        if (value) {
            bind(*value);
        } else {
            statement_.bind_null(parameter_);
        }
    }

    Statement& statement_;
    int parameter_ = 0;
};

}  // namespace gazeloop::session
