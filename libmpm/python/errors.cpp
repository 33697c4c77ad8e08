// C++ exceptions as Python's, and what else Python hands over in words.
#include "base/error.hpp"
#include "python/session.hpp"

namespace mpm::python
{
namespace
{
// They live as long as the interpreter, which may end after this library's static objects.
PyObject* couplingError = nullptr;
PyObject* inputError = nullptr;
PyObject* stepError = nullptr;

PyObject* define(py::module_& module, const char* name, PyObject* base, const char* text)
{
    const std::string whole = std::string("libmpm.") + name;
    PyObject* made = PyErr_NewExceptionWithDoc(whole.c_str(), text, base, nullptr);
    if (!made)
        throw py::error_already_set();
    module.attr(name) = py::handle(made);
    return made;
}

void raise(const coupling::CouplingError& error)
{
    const py::object made = py::handle(couplingError)(error.what());
    made.attr("fault") = coupling::faultName(error.fault());
    PyErr_SetObject(couplingError, made.ptr());
}

void translate(std::exception_ptr thrown)
{
    try
    {
        if (thrown)
            std::rethrow_exception(thrown);
    }
    catch (const coupling::CouplingError& error)
    {
        raise(error);
    }
    catch (const InputError& error)
    {
        PyErr_SetString(inputError, error.what());
    }
    catch (const StepError& error)
    {
        PyErr_SetString(stepError, error.what());
    }
}

std::string valueText(const py::handle& value)
{
    if (value.is_none())
        return ""; // takes the word away
    if (py::isinstance<py::bool_>(value))
        return value.cast<bool>() ? "yes" : "no";
    if (py::isinstance<py::str>(value))
        return value.cast<std::string>();
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || py::hasattr(value, "tolist"))
    {
        const py::object items =
            py::hasattr(value, "tolist") ? value.attr("tolist")() : py::reinterpret_borrow<py::object>(value);
        if (!py::isinstance<py::sequence>(items)) // a scalar of numpy
            return valueText(items);
        std::string text = "(";
        for (const py::handle item : items)
            text += (text.size() > 1 ? " " : "") + valueText(item);
        return text + ")";
    }
    if (PyNumber_Check(value.ptr()))
        return py::repr(PyIndex_Check(value.ptr()) ? py::object(py::int_(py::reinterpret_borrow<py::object>(value)))
                                                   : py::float_(py::reinterpret_borrow<py::object>(value)))
            .cast<std::string>();
    throw py::type_error("settings: found " + py::repr(value).cast<std::string>() +
                         ", allowed numbers, True and False, text, lists of these, None to take a word away");
}
} // namespace

std::vector<coupling::Setting> settingsOf(const py::object& settings)
{
    std::vector<coupling::Setting> made;
    if (settings.is_none())
        return made;
    if (!py::isinstance<py::dict>(settings))
        throw py::type_error("settings: allowed is {file: {word: value}}");
    for (const auto& [file, words] : py::reinterpret_borrow<py::dict>(settings))
    {
        if (!py::isinstance<py::str>(file) || !py::isinstance<py::dict>(words))
            throw py::type_error("settings: allowed is {file: {word: value}}");
        for (const auto& [word, value] : py::reinterpret_borrow<py::dict>(words))
        {
            if (!py::isinstance<py::str>(word))
                throw py::type_error("settings: a word is a text, as \"soil.cohesion\"");
            made.push_back({file.cast<std::string>(), word.cast<std::string>(), valueText(value)});
        }
    }
    return made;
}

void defineErrors(py::module_& module)
{
    couplingError = define(module, "CouplingError", PyExc_RuntimeError,
                           "A call that cannot be done; the participant is as it was before. `fault` is its name: "
                           "callOrder, unknownSurface, unknownField, wrongSize, notFinite, badValue, badWindow, "
                           "badSurface, jump, badState, files.");
    inputError = define(module, "InputError", PyExc_ValueError,
                        "What is wrong in the case: file:line, what was found, what is allowed.");
    stepError = define(module, "StepError", PyExc_RuntimeError, "The calculation cannot go on.");
    py::register_exception_translator(&translate);
}
} // namespace mpm::python
