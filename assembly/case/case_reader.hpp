#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/case/schema_table.hpp"

namespace cupola {

/// Reads a case file: resolves `extends`, applies `--set key.path=value`, and checks that every key is known
/// and every value has the right type and range. Throws InputError with file, line, column, key path, the
/// rule broken and the nearest valid key. Without options, the keys and values of a sweep or ensemble are
/// checked like them.
Case read_case(const std::string& path, const std::vector<std::string>& set_options = {});

/// Checks the samples of the case as if each value were set: of numbers the least and the greatest of each
/// key, every other text, and the first member whole, beside `settings`. `source` begins the message of the
/// InputError.
void check_samples(const std::string& path, const std::vector<std::string>& settings, const char* source,
                   const Samples& samples);

/// All keys: path, type, unit, range, default, meaning.
SchemaTable case_schema_table();
/// The same as text (`--schema`): all keys, or `key` and the keys of that section. Throws InputError for an
/// unknown key, with the nearest one.
std::string case_schema(const std::string& key = "");
/// The same as a JSON schema for editors (`--schema --json`).
std::string case_json_schema();

}  // namespace cupola
