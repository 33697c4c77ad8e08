#include "fuzz/callSequence.hpp"
#include "support/blockCase.hpp"

#include <cmath>
#include <cstring>

namespace mpm::fuzz
{
namespace
{
constexpr double canary = 12345.678;
const std::vector<double> box = {-0.8, 0.15, 0, -0.2, 0.15, 0, -0.2, 1, 0, -0.8, 1, 0};
const std::vector<double> plate = {1.1, 0.1, 0, 1.7, 0.1, 0, 1.7, 0.9, 0, 1.1, 0.9, 0};
const std::vector<double> line = {0, 0.4, 0, 0.5, 0.4, 0, 1, 0.4, 0};
const std::vector<int64_t> loop = {0, 1, 1, 2, 2, 3, 3, 0}, path = {0, 1, 1, 2};

mpm_status add(mpm_participant* p, const char* name, int32_t kind, const std::vector<double>& x,
               const std::vector<int64_t>& e)
{
    return mpm_participant_add_coupling_surface(p, name, kind, x.data(), x.size() / 3, e.data(), e.size() / 2, nullptr);
}

Seen look(mpm_participant* p)
{
    Seen seen;
    seen.said = {mpm_participant_lifecycle(p, &seen.lifecycle), mpm_participant_time(p, &seen.time),
                 mpm_participant_balance(p, &seen.balance)};
    return seen;
}

bool untouched(const std::vector<double>& values)
{
    for (const double value : values)
        if (value != canary)
            return false;
    return true;
}
} // namespace

bool Seen::operator==(const Seen& other) const
{
    return said == other.said && lifecycle == other.lifecycle && std::memcmp(&time, &other.time, sizeof(time)) == 0 &&
           std::memcmp(&balance, &other.balance, sizeof(balance)) == 0;
}

CallSequence::CallSequence()
{
    for (const char* name : {"steady", "fresh"})
        tests::writeBlockCase(folder_.path() / name);
}

CallSequence::~CallSequence()
{
    mpm_state_free(start_);
    for (auto* p : p_)
        mpm_participant_destroy(p);
}

/// The steady one at its start; made anew where it was ended.
void CallSequence::begin()
{
    if (p_[steady] && mpm_participant_restore_state(p_[steady], start_) == MPM_OK)
        return;
    mpm_state_free(start_);
    mpm_participant_destroy(p_[steady]);
    std::filesystem::remove_all(folder_.path() / "steady");
    tests::writeBlockCase(folder_.path() / "steady");
    mpm_participant*& p = p_[steady];
    require(mpm_participant_create((folder_.path() / "steady").c_str(), nullptr, 0, 1, &p) == MPM_OK, "a case is read");
    require(add(p, "wall", MPM_RIGID, box, loop) == MPM_OK && add(p, "skin", MPM_DEFORMABLE, plate, loop) == MPM_OK &&
                add(p, "probe", MPM_MONITOR, line, path) == MPM_OK,
            "surfaces are taken");
    require(mpm_participant_initialize(p) == MPM_OK, "it begins");
    require(mpm_participant_save_state(p, &start_) == MPM_OK, "it is saved");
}

void CallSequence::run(const std::uint8_t* data, std::size_t size)
{
    begin();
    data_ = data, left_ = size;
    while (left_ > 0)
        one();
    for (const Saved& saved : saved_)
        require(mpm_state_free(saved.state) == MPM_OK, "a state is freed");
    saved_.clear();
    mpm_participant_destroy(p_[fresh]);
    p_[fresh] = nullptr;
    if (gone_.size() > 16)
        gone_.erase(gone_.begin(), gone_.end() - 16);
}

mpm_status CallSequence::checked(mpm_status status)
{
    ++calls_;
    granted_ += status == MPM_OK;
    const char* text = mpm_last_error();
    static const bool says = std::getenv("MPM_FUZZ_SAYS") != nullptr;
    if (says)
        std::fprintf(stderr, "%d %s\n", int(status), text);
    require((status == MPM_OK) == (text[0] == 0), "a refusal says something, and only a refusal");
    require(std::strcmp(mpm_status_word(status), "unknown") != 0, "a status has a word");
    require(status != MPM_INTERNAL && status != MPM_OUT_OF_MEMORY, "no mistake of ours");
    return status;
}

template <class Call>
mpm_status CallSequence::changing(mpm_participant* p, Call&& call)
{
    const Seen before = look(p);
    const mpm_status status = checked(call());
    if (status != MPM_OK)
        require(look(p) == before, "a refused call changes nothing");
    return status;
}

void CallSequence::one()
{
    const unsigned verb = byte();
    mpm_participant* const p = participant();
    switch (verb % 8)
    {
    case 0:
    case 1:
    case 2:
    case 3:
        return exchange(p, byte());
    case 4:
        return describe(p, byte());
    case 5:
        return build(p, byte());
    case 6:
        return keep(p, byte());
    default:
        return end(p, byte());
    }
}

void CallSequence::describe(mpm_participant* p, unsigned verb)
{
    size_t count = 0;
    double number = canary;
    int32_t kind = 0;
    const size_t room = byte() % 32;
    std::vector<char> text(room + 1);
    std::vector<mpm_field> fields(room + 1);
    std::vector<double> vertices(room + 1, canary);
    std::vector<int64_t> elements(room + 1);
    switch (verb % 8)
    {
    case 0:
        checked(mpm_participant_surface_name(p, byte() % 5, text.data(), room, &count));
        return;
    case 1:
        checked(mpm_participant_fields(p, name(), fields.data(), room, &count));
        return;
    case 2:
        if (checked(mpm_participant_vertices(p, name(), vertices.data(), room, &count)) != MPM_OK)
            require(untouched(vertices), "a refused call fills nothing");
        require(vertices[room] == canary, "nothing is written beyond the buffer");
        return;
    case 3:
        checked(mpm_participant_elements(p, name(), elements.data(), room, &count));
        return;
    case 4:
        checked(mpm_participant_kind(p, name(), &kind));
        return;
    case 5:
        checked(mpm_participant_value_count(p, name(), enumerator(), &count));
        return;
    case 6:
        checked(mpm_participant_stable_time_step(p, &number));
        return;
    default:
        checked(mpm_participant_dimension(p, byte() % 4 ? &kind : nullptr));
    }
}

void CallSequence::makeFresh()
{
    const bool wanted = byte() % 6 == 0 && !p_[fresh];
    const mpm_setting settings[] = {{"system/controlDict", "adjustTimeStep", byte() % 2 ? "yes" : "no"},
                                    {"system/mpmSchemes", "picRate", byte() % 4 ? "1" : "none"}};
    const auto folder = folder_.path() / (wanted ? "fresh" : "nowhere");
    if (wanted) // what an earlier one left
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (const auto name = entry.path().filename(); name != "0" && name != "system" && name != "constant")
                std::filesystem::remove_all(entry.path());
    mpm_participant* made = nullptr;
    if (checked(mpm_participant_create(folder.c_str(), settings, byte() % 3, 1, &made)) == MPM_OK)
        p_[fresh] = made;
    else
        require(!made, "a refused call fills nothing");
}

void CallSequence::build(mpm_participant* p, unsigned verb)
{
    switch (verb % 6)
    {
    case 0:
    case 1: {
        auto x = byte() % 2 ? box : plate;
        auto e = loop;
        const unsigned b = byte(), kind = byte();
        if (b % 4 == 1)
            x[b / 4 % x.size()] = double(kind) / 64 - 2;
        if (b % 4 == 2)
            e[b / 4 % e.size()] = int64_t(kind) - 2;
        if (b % 4 == 3)
            e.resize(b / 4 % (e.size() / 2) * 2);
        changing(p, [&] { return add(p, name(), int32_t(kind % 4), x, e); });
        return;
    }
    case 2:
        changing(p, [&] { return mpm_participant_set_interpolation(p, name(), enumerator(), int32_t(byte() % 4)); });
        return;
    case 3: {
        auto x = line;
        x[0] = double(byte()) / 64 - 1;
        changing(p, [&] {
            return mpm_participant_set_partner_mesh(p, name(), x.data(), byte() % 4, path.data(), byte() % 3,
                                                    int32_t(byte() % 3));
        });
        return;
    }
    case 4:
        return makeFresh();
    default:
        changing(p, [&] { return mpm_participant_initialize(p); });
    }
}

void CallSequence::exchange(mpm_participant* p, unsigned verb)
{
    const char* surface = name();
    const int32_t field = enumerator();
    size_t count = 0;
    mpm_participant_value_count(p, surface, field, &count);
    switch (verb % 8)
    {
    case 0:
    case 1:
    case 2: {
        const auto given = values(count);
        const double time = byte() % 4 ? window() : 0;
        changing(p, [&] { return mpm_participant_write_field(p, surface, field, given.data(), given.size(), time); });
        return;
    }
    case 3:
    case 4: {
        const Seen before = look(p);
        const double length = window();
        mpm_advance reached{canary, 0};
        if (changing(p, [&] { return mpm_participant_advance(p, length, &reached); }) == MPM_OK)
            require(reached.time == before.time + length && look(p).time == reached.time && reached.substeps > 0,
                    "a window ends where it was asked to");
        return;
    }
    case 5: {
        std::vector<double> out(byte() % 8 ? count : byte() % 16, canary);
        if (checked(mpm_participant_read_field(p, surface, field, out.data(), out.size())) != MPM_OK)
            require(untouched(out), "a refused call fills nothing");
        return;
    }
    case 6: {
        std::vector<double> out(count, canary);
        if (checked(mpm_participant_window_average(p, surface, field, out.data(), out.size())) != MPM_OK)
            require(untouched(out), "a refused call fills nothing");
        return;
    }
    default: {
        mpm_resultants sums{};
        double work = 0;
        checked(mpm_participant_resultants(p, surface, &sums));
        checked(mpm_participant_interface_work(p, surface, &work));
    }
    }
}

void CallSequence::keep(mpm_participant* p, unsigned verb)
{
    const std::size_t which = savedState();
    const bool any = which < saved_.size();
    mpm_state* const state = any ? saved_[which].state : verb % 2 ? nullptr : reinterpret_cast<mpm_state*>(this);
    switch (verb % 6)
    {
    case 0:
    case 1: {
        mpm_state* made = nullptr;
        if (checked(mpm_participant_save_state(p, &made)) == MPM_OK)
            saved_.push_back({made, p, look(p)});
        return;
    }
    case 2:
    case 3: {
        const mpm_status said = changing(p, [&] { return mpm_participant_restore_state(p, state); });
        const bool own = any && saved_[which].of == p && look(p).lifecycle != MPM_FINALIZED;
        if (own && look(p).said[0] == MPM_OK)
            require(said == MPM_OK, "a participant takes its own state");
        if (said == MPM_OK && own)
        {
            Seen now = look(p);
            now.lifecycle = saved_[which].seen.lifecycle;
            require(now == saved_[which].seen, "a restored participant is as it was");
        }
        return;
    }
    case 4:
        if (byte() % 4 == 0) // milliseconds each
            bytesOf(p);
        return;
    default:
        if (checked(mpm_state_free(state)) == MPM_OK && any)
            saved_.erase(saved_.begin() + std::ptrdiff_t(which));
    }
}

/// A state there and back; or changed on the way.
void CallSequence::bytesOf(mpm_participant* p)
{
    const std::size_t which = savedState();
    if (which == saved_.size())
        return;
    size_t count = 0;
    if (checked(mpm_state_serialise(p, saved_[which].state, nullptr, 0, &count)) != MPM_OK)
        return;
    std::vector<unsigned char> bytes(count);
    require(checked(mpm_state_serialise(p, saved_[which].state, bytes.data(), count, &count)) == MPM_OK &&
                count == bytes.size(),
            "a state is as long as was said");
    const unsigned change = byte(), where = byte() * 256 + byte();
    if (change % 4 == 1)
        bytes.resize(where % count);
    if (change % 4 == 2)
        bytes[where % count] ^= static_cast<unsigned char>(1 + change / 4);
    if (change % 4 == 3)
        bytes.resize(count + 1 + where % 100);
    mpm_state* made = nullptr;
    const mpm_status said = checked(mpm_state_deserialise(p, bytes.data(), bytes.size(), &made));
    const bool own = saved_[which].of == p; // another participant may have other surfaces
    require(change % 4 ? said == MPM_BAD_STATE : said == MPM_OK || (!own && said == MPM_BAD_STATE),
            "bytes that were changed are refused, others taken");
    if (said == MPM_OK)
        saved_.push_back({made, p, saved_[which].seen});
}

void CallSequence::end(mpm_participant* p, unsigned verb)
{
    static const std::array<const char*, 6> files = {"wall.vtp", "wall.msh", "wall.stl", "wall", "no/wall.vtp", ""};
    switch (verb % 64)
    {
    case 0:
        changing(p, [&] { return mpm_participant_finalize(p); });
        return;
    case 1:
        if (checked(mpm_participant_destroy(p)) == MPM_OK && p)
        {
            gone_.push_back(p);
            for (auto& held : p_)
                held = held == p ? nullptr : held;
        }
        return;
    default:
        if (verb % 2)
            changing(p, [&] { return mpm_participant_accept_window(p); });
        else
            changing(p, [&] {
                return mpm_participant_export_surface(p, name(),
                                                      (folder_.path() / files[byte() % files.size()]).c_str());
            });
    }
}
} // namespace mpm::fuzz
