#include "output/runScript.hpp"

#include "base/error.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mpm::output
{
void runScript(const std::filesystem::path& script, const std::vector<std::string>& arguments)
{
    std::vector<std::string> words{script.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0)
    {
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = -1;
    if (child < 0 || ::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw InputError(fmt::format("{}: the script {}", script.string(),
                                     child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 127
                                         ? "could not be started; is it there and executable, and is /usr/bin/python3?"
                                         : "failed"));
}
} // namespace mpm::output
