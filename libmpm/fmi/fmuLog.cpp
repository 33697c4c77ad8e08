#include "fmi/fmuLog.hpp"

#include <vector>

namespace mpm::fmi
{
void Log::set(bool on, std::size_t count, const fmi3String* categories)
{
    auto changed = on_;
    if (count == 0)
        changed.fill(on);
    for (std::size_t i = 0; i < count; ++i)
    {
        std::size_t at = 0;
        const std::string name = categories && categories[i] ? categories[i] : "";
        while (at < logCategories.size() && name != logCategories[at].first)
            ++at;
        if (at == logCategories.size())
            throw Refusal("fmi3SetDebugLogging: found the category '" + name +
                          "', allowed logEvents, logStatusWarning, logStatusDiscard, logStatusError, logStatusFatal");
        changed[at] = on;
    }
    on_ = changed;
}

void Log::operator()(fmi3Status status, const std::string& message) const
{
    if (!callback_ || (status < fmi3Error && !on_[std::size_t(status)]))
        return;
    std::string text; // '#' would begin a value reference
    for (const char c : message)
        text += c == '#' ? std::string("##") : std::string(1, c);
    callback_(environment_, status, logCategories[std::size_t(status)].first, text.c_str());
}
} // namespace mpm::fmi
