// Prints a dictionary as libmpm understands it, macros expanded and includes merged: dictionaryText FILE CASE
#include "base/error.hpp"
#include "dictionary/dictionary.hpp"

#include <cstdio>

int main(int argc, char** argv)
{
    if (argc != 3)
        return std::fputs("usage: dictionaryText FILE CASE\n", stderr), 1;
    try
    {
        std::fputs(mpm::dictionary::Dictionary::readFile(argv[1], argv[2]).text().c_str(), stdout);
    }
    catch (const mpm::InputError& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
