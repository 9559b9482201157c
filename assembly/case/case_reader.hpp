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

/// Hash of all keys as given, except `sweep` and `ensemble`, and of the contents of the files that they name:
/// what one member depends on. The members are not checked.
std::string hash_of_inputs(const std::string& path, const std::vector<std::string>& set_options = {});

/// Checks members of the case, whole, because keys may depend on each other: those with the least and the
/// greatest number of a key and one with every other text, beside `settings`. `source` begins the message of
/// the InputError.
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
