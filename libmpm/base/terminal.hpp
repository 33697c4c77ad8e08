#pragma once
/// What a person sees while a program works: a progress line, durations, sizes, aligned tables.
///
/// On a terminal Progress redraws one line, at most 10 times a second, and removes it at the end. In a file it writes
/// plain lines, one every 10 % or every 30 s, whichever comes first. The time left comes from the rate of the last
/// stretch of work, smoothed over about 5 s, so it follows a run that gets slower.
///
///     Progress progress("mpmSolve", 0, 2.5);
///     progress.update(time, fmt::format("dt {:.3g} s  {} particles", dt, count));
///     progress.finish();
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace mpm
{
/// "0.42 s", "12.3 s", "1 min 05 s", "2 h 03 min", "4 d 01 h"; "unknown" unless finite and not negative.
std::string formatDuration(double seconds);
/// "512 B", "1.5 kB", "3.2 MB", ... (powers of 1000).
std::string formatBytes(double bytes);
/// Does standard output go to a terminal?
bool isTerminal();
/// Columns of the terminal, 80 when unknown.
int terminalWidth();

class Progress
{
  public:
    /// Where the line goes and what time it is; for tests. Default: standard output and the steady clock.
    struct Surroundings
    {
        std::ostream* out = nullptr;
        bool terminal = false;
        int width = 80;                ///< columns; 0: ask the terminal at every line, it may be resized
        std::function<double()> clock; ///< seconds
    };

    Progress(std::string what, double begin, double end);
    Progress(std::string what, double begin, double end, Surroundings surroundings);
    ~Progress(); ///< finishes; after an exception too, so that its message stands on a line of its own
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `now` lies between begin and end; cheap enough for every step.
    void update(double now, const std::string& details = "");
    /// Is a line due? Lets the caller skip making the details.
    bool due(double now) const;
    /// For work that is done in large pieces and measured in no unit of its own: no value of it is shown, and the time
    /// left comes from the mean rate.
    void inPieces() { inPieces_ = true; }
    /// A line of text that stays, above the progress line.
    void note(const std::string& text);
    /// On a terminal removes the line. Nothing is written afterwards.
    void finish();

    double elapsed() const;

  private:
    double fraction(double now) const;
    double timeLeft(double fraction) const;
    void measureRate(double now);
    void draw(double now, const std::string& details);
    void erase();

    std::string what_;
    double begin_, end_;
    Surroundings surroundings_;
    double started_ = 0;
    double lastDrawn_ = -1e300;
    double lastMeasured_ = 0, lastFraction_ = 0, rate_ = 0;
    int lastTenth_ = 0;
    std::size_t lineLength_ = 0;
    bool finished_ = false, inPieces_ = false;
};

/// Aligned columns: texts to the left, numbers to the right.
///
///     Table table({"quantity", "value", "unit"});
///     table.row({"particles", "1800", ""});
///     out << table.text();
class Table
{
  public:
    explicit Table(std::vector<std::string> heads = {}) : heads_(std::move(heads)) {}
    void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    std::string text(int indent = 0) const;

  private:
    std::vector<std::string> heads_;
    std::vector<std::vector<std::string>> rows_;
};
} // namespace mpm
