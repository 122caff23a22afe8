// Uses of the description of a table other than reading: values as TOML or JSON, JSON Schema, reference.
#pragma once

#include <string>

#include "ripstop/core/toml/fields.h"

namespace ripstop {

/// The bound values, absent optional values left out. Reading the TOML gives the same values, bit by bit.
std::string to_toml(const Fields& fields);
std::string to_json(const Fields& fields);

/// JSON Schema (draft 2020-12) of the tables; defaults are the bound values. Writes into lists and named
/// tables behind `fields`, to have an element to describe: bind a scratch struct.
std::string json_schema(const Fields& fields, const std::string& title);

/// Markdown: one heading and one table a TOML table. Needs a scratch struct as json_schema() does.
std::string reference_tables(const Fields& fields);

}  // namespace ripstop
