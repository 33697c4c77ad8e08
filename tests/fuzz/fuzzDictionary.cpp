// Text as a dictionary: parsed, every entry asked for in every type, written back and read again.
#include "dictionary/dictionary.hpp"
#include "fuzz/fuzzing.hpp"

using namespace mpm;
using namespace mpm::dictionary;

namespace
{
template <class T>
void ask(const Dictionary& dictionary, const std::string& word)
{
    fuzz::accepted([&] { dictionary.get<T>({word, "", unit::none, Bound::nonNegative()}); });
}

void askAll(const Dictionary& dictionary)
{
    for (const std::string& word : dictionary.words())
    {
        ask<double>(dictionary, word);
        ask<Index>(dictionary, word);
        ask<bool>(dictionary, word);
        ask<std::string>(dictionary, word);
        ask<Dimensions>(dictionary, word);
        ask<Vector3>(dictionary, word);
        ask<std::vector<double>>(dictionary, word);
        ask<std::vector<std::string>>(dictionary, word);
        ask<std::vector<Vector3>>(dictionary, word);
        fuzz::accepted([&] { dictionary.choose(word, "", {{"linear", ""}, {"uGIMP", ""}}); });
        fuzz::accepted([&] { dictionary.checkDimensions(unit::acceleration, word); });
    }
    fuzz::accepted([&] { ask<double>(dictionary, "wordNobodyWrote"); });
    fuzz::accepted([&] { dictionary.rejectUnread(); });
    for (const std::string& name : dictionary.dictNames())
        askAll(dictionary.subDict(name));
    fuzz::require(!dictionary.schema().empty(), "questions are remembered");
}

void useAll(const Dictionary& dictionary)
{
    askAll(dictionary);
    const std::string text = dictionary.text();
    std::string again;
    fuzz::require(fuzz::accepted([&] { again = Dictionary::fromText(text).text(); }), "what was written can be read");
    fuzz::require(again == text, "what was written is read as the same");
}
} // namespace

/// A text that begins with '@' is a file of a case, whose #include finds one other.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Folder folder;
    static const auto other = folder.write("system/other", "nu 0.3;\nsoil { E 1; }\n");
    const std::string text(reinterpret_cast<const char*>(data), size);
    fuzz::accepted([&] {
        if (!text.empty() && text[0] == '@')
            useAll(Dictionary::readFile(folder.write("system/dict", text.substr(1))));
        else
            useAll(Dictionary::fromText(text));
    });
    return 0;
}
