#include "fmi/fmuArchive.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <set>
#include <zip.h>

namespace mpm::fmi
{
namespace fs = std::filesystem;

FmuArchive::FmuArchive(const fs::path& file) : file_(file)
{
    int code = 0;
    zip_ = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (zip_)
        return;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw InputError(fmt::format("cannot write {}: {}", file.string(), why));
}

FmuArchive::~FmuArchive()
{
    if (zip_)
        zip_discard(zip_);
}

void FmuArchive::fail() const
{
    throw InputError(fmt::format("cannot write {}: {}", file_.string(), zip_strerror(zip_)));
}

void FmuArchive::add(const std::string& name, ::zip_source* source)
{
    if (!source)
        fail();
    const auto index = zip_file_add(zip_, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0)
    {
        zip_source_free(source);
        fail();
    }
    if (zip_set_file_compression(zip_, zip_uint64_t(index), ZIP_CM_DEFLATE, 0) != 0)
        fail();
}

void FmuArchive::addText(const std::string& name, const std::string& text)
{
    void* copy = std::malloc(text.size() + 1); // libzip frees it
    if (!copy)
        throw std::bad_alloc();
    std::memcpy(copy, text.c_str(), text.size() + 1);
    add(name, zip_source_buffer(zip_, copy, text.size(), 1));
}

void FmuArchive::addFile(const std::string& name, const fs::path& file)
{
    add(name, zip_source_file(zip_, file.c_str(), 0, -1));
}

void FmuArchive::addFolder(const std::string& name, const fs::path& folder)
{
    std::set<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files.insert(entry.path());
    for (const fs::path& file : files)
        addFile(name + "/" + file.lexically_relative(folder).generic_string(), file);
}

void FmuArchive::close()
{
    if (zip_close(zip_) != 0)
        fail();
    zip_ = nullptr;
}
} // namespace mpm::fmi
