#include "base/terminal.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace mpm
{
namespace
{
constexpr double redrawSeconds = 0.1;   // on a terminal
constexpr double lineSeconds = 30;      // in a file
constexpr double measureSeconds = 0.25; // shorter stretches are noise
constexpr double memorySeconds = 5;     // of the smoothed rate

double steadySeconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool looksLikeNumber(const std::string& cell)
{
    const std::size_t first = cell.find_first_not_of("+-");
    return first != std::string::npos && (std::isdigit(static_cast<unsigned char>(cell[first])) || cell[first] == '.');
}

/// Columns a text takes: bytes that continue a UTF-8 character take none.
std::size_t columns(const std::string& text)
{
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}
} // namespace

std::string formatDuration(double seconds)
{
    if (!std::isfinite(seconds) || seconds < 0)
        return "unknown";
    if (seconds < 9.995)
        return fmt::format("{:.2f} s", seconds);
    if (seconds < 59.95)
        return fmt::format("{:.1f} s", seconds);
    if (seconds > 1e9)
        return "years";
    const long long total = std::llround(seconds);
    if (total < 3600)
        return fmt::format("{} min {:02d} s", total / 60, total % 60);
    const long long minutes = std::llround(seconds / 60);
    if (minutes < 24 * 60)
        return fmt::format("{} h {:02d} min", minutes / 60, minutes % 60);
    const long long hours = std::llround(seconds / 3600);
    return fmt::format("{} d {:02d} h", hours / 24, hours % 24);
}

std::string formatBytes(double bytes)
{
    if (!std::isfinite(bytes) || bytes < 0)
        return "unknown";
    if (bytes < 999.5)
        return fmt::format("{:.0f} B", bytes);
    static constexpr const char* units[] = {"kB", "MB", "GB", "TB", "PB"};
    std::size_t unit = 0;
    for (bytes /= 1000; bytes >= 999.95 && unit + 1 < std::size(units); ++unit)
        bytes /= 1000;
    return fmt::format("{:.1f} {}", bytes, units[unit]);
}

bool isTerminal()
{
    const char* kind = std::getenv("TERM");
    return isatty(STDOUT_FILENO) != 0 && !(kind && std::string(kind) == "dumb"); // a dumb one cannot redraw a line
}

int terminalWidth()
{
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

Progress::Progress(std::string what, double begin, double end)
    : Progress(std::move(what), begin, end, {&std::cout, isTerminal(), 0, steadySeconds})
{}

Progress::Progress(std::string what, double begin, double end, Surroundings surroundings)
    : what_(std::move(what)), begin_(begin), end_(end), surroundings_(std::move(surroundings))
{
    started_ = lastMeasured_ = surroundings_.clock();
    if (!surroundings_.terminal)
        lastDrawn_ = started_; // the first plain line waits for 10 % or 30 s
}

Progress::~Progress()
{
    finish();
}

double Progress::elapsed() const
{
    return surroundings_.clock() - started_;
}

double Progress::fraction(double now) const
{
    return end_ > begin_ ? std::clamp((now - begin_) / (end_ - begin_), 0.0, 1.0) : 1.0;
}

double Progress::timeLeft(double fraction) const
{
    if (inPieces_)
        return fraction > 0 ? elapsed() * (1 - fraction) / fraction : -1;
    return rate_ > 0 ? (1 - fraction) / rate_ : -1;
}

/// Exponential mean of progress per second; its memory begins with the whole past and settles at memorySeconds.
void Progress::measureRate(double now)
{
    const double clock = surroundings_.clock(), stretch = clock - lastMeasured_;
    if (stretch < measureSeconds)
        return;
    const double done = fraction(now), fresh = (done - lastFraction_) / stretch;
    const double weight = stretch / std::min(clock - started_, std::max(memorySeconds, stretch));
    rate_ += weight * (fresh - rate_);
    lastMeasured_ = clock;
    lastFraction_ = done;
}

bool Progress::due(double now) const
{
    if (finished_)
        return false;
    const double since = surroundings_.clock() - lastDrawn_;
    if (surroundings_.terminal)
        return since >= redrawSeconds;
    return since >= lineSeconds || int(fraction(now) * 10 + 1e-9) > lastTenth_;
}

void Progress::update(double now, const std::string& details)
{
    if (finished_)
        return;
    measureRate(now);
    if (due(now))
        draw(now, details);
}

void Progress::draw(double now, const std::string& details)
{
    const double done = fraction(now), left = timeLeft(done);
    const std::string times = fmt::format("{} elapsed{}", formatDuration(elapsed()),
                                          left < 0 || done >= 1 ? "" : ", " + formatDuration(left) + " left");
    const std::string value = inPieces_ ? "" : fmt::format("time {:.6g} s{}", now, details.empty() ? "" : "  ");
    const std::string state = fmt::format("{}{}  {}", value, details, times);
    std::ostream& out = *surroundings_.out;
    if (surroundings_.terminal)
    {
        constexpr int barWidth = 20;
        const int filled = int(done * barWidth);
        std::string line = fmt::format("{} [{}{}] {:3.0f} %  {}", what_, std::string(std::size_t(filled), '='),
                                       std::string(std::size_t(barWidth - filled), ' '), std::floor(done * 100), state);
        const int width = surroundings_.width > 0 ? surroundings_.width : terminalWidth();
        if (columns(line) >= std::size_t(width)) // a wrapped line could not be redrawn
            line.resize(std::size_t(width - 1));
        const std::size_t length = columns(line);
        out << '\r' << line << std::string(lineLength_ > length ? lineLength_ - length : 0, ' ') << std::flush;
        lineLength_ = length;
    }
    else
        out << fmt::format("{}: {:3.0f} %  {}\n", what_, std::floor(done * 100), state) << std::flush;
    lastDrawn_ = surroundings_.clock();
    lastTenth_ = int(done * 10 + 1e-9);
}

void Progress::erase()
{
    if (surroundings_.terminal && lineLength_ > 0)
        *surroundings_.out << '\r' << std::string(lineLength_, ' ') << '\r' << std::flush;
    lineLength_ = 0;
}

void Progress::note(const std::string& text)
{
    erase();
    *surroundings_.out << text << '\n' << std::flush;
    if (surroundings_.terminal)
        lastDrawn_ = -1e300; // the line comes back with the next update
}

void Progress::finish()
{
    if (finished_)
        return;
    finished_ = true;
    erase();
}

std::string Table::text(int indent) const
{
    std::size_t count = heads_.size();
    for (const auto& cells : rows_)
        count = std::max(count, cells.size());
    std::vector<std::size_t> width(count, 0);
    std::vector<bool> right(count, !rows_.empty()); // a column of numbers, empty cells aside, stands to the right
    for (std::size_t i = 0; i < count; ++i)
    {
        if (i < heads_.size())
            width[i] = columns(heads_[i]);
        for (const auto& cells : rows_)
            if (i < cells.size())
            {
                width[i] = std::max(width[i], columns(cells[i]));
                right[i] = right[i] && (cells[i].empty() || looksLikeNumber(cells[i]));
            }
    }
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string out(std::size_t(indent), ' ');
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
            const std::string blanks(width[i] - columns(cells[i]), ' ');
            out += (i == 0 ? "" : "  ") + (right[i] ? blanks + cells[i] : cells[i] + blanks);
        }
        out.erase(out.find_last_not_of(' ') + 1);
        return out + "\n";
    };
    std::string out = heads_.empty() ? "" : line(heads_);
    for (const auto& cells : rows_)
        out += line(cells);
    return out;
}
} // namespace mpm
