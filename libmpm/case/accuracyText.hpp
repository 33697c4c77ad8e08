#pragma once
/// Changing one entry of a dictionary in its text, so that comments, order and layout of all else stay.
///
///     cellSize    0.4;     // [m]      ->  replaceEntry(text, "cellSize", "0.2")  ->  cellSize    0.2;     // [m]
///
/// Only entries at the top of the file are found; comments, texts in quotes, lists and nested dictionaries are stepped
/// over. The text must be one dictionary::Dictionary has read: mistakes of form are told there, with their line.
#include <optional>
#include <string>

namespace mpm::cases
{
/// The entry's value becomes `value`; an entry that is not there is appended. A nested dictionary of that name is
/// replaced as a whole.
std::string replaceEntry(const std::string& text, const std::string& word, const std::string& value);

/// The entry or nested dictionary goes, with the line it leaves empty.
std::string removeEntry(const std::string& text, const std::string& word);

/// The value as it stands in the text; nothing if there is no such entry at the top of this file itself.
std::optional<std::string> entryText(const std::string& text, const std::string& word);
} // namespace mpm::cases
