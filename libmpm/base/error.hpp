#pragma once
/// The two ways a run can end before its time.
///
/// InputError: what the user wrote or passed is wrong; the message says where (file:line), what was found and what is
/// allowed. Programs print it and exit with 1, having written nothing.
/// StepError: the calculation cannot go on; the message names step, time and particle or node and the last good state.
/// Programs print it and exit with 2.
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm
{
/// A place in a text file; line 0 means the file as a whole.
struct Location
{
    std::string file;
    int line = 0;
    std::string text() const; ///< "file:line", or "file"
};

class InputError : public std::runtime_error
{
  public:
    explicit InputError(const std::string& what);
    InputError(const Location& where, const std::string& what);
};

class StepError : public std::runtime_error
{
  public:
    explicit StepError(const std::string& what);
};

/// A particle has left the grid: smaller steps would not help, a larger grid would.
class OutsideGrid : public StepError
{
  public:
    using StepError::StepError;
};

/// The candidate closest to `word` by edit distance, ignoring case; empty if none is near: the distance is at
/// most 1 + length/3 and less than the length. Words beyond 64 characters have no near ones.
std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates);

/// " a, b or c" for messages.
std::string joinWords(const std::vector<std::string>& words, const std::string& lastSeparator = " or ");
} // namespace mpm
