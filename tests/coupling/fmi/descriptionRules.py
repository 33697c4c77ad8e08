"""Rules of FMI 3.0 for modelDescription.xml that need more than the names of elements (FMI 3.0.2, section 2.4)."""

import re

STRUCTURED = re.compile(r"(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+')(?:\.(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+'))*")


def violations(root):
    """What is wrong, one text a rule that is broken."""
    found = []
    variables = list(root.find("ModelVariables"))

    def rule(holds, text):
        if not holds:
            found.append(text)

    order = [child.tag for child in root]
    rule(order == ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
                   "ModelStructure"], f"order of elements {order}")
    rule(re.fullmatch(r"3\.\d+", root.get("fmiVersion")), "fmiVersion")
    rule(re.fullmatch(r"[A-Za-z_]\w*", root.find("CoSimulation").get("modelIdentifier")), "modelIdentifier")
    rule(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", root.get("generationDateAndTime")), "date")
    names = [v.get("name") for v in variables]
    references = [v.get("valueReference") for v in variables]
    rule(len(set(names)) == len(names), "names are unique")
    rule(len(set(references)) == len(references), "value references are unique")
    rule(all(STRUCTURED.fullmatch(n) for n in names), "names are structured")
    rule(not any(b.startswith(a + ".") for a in names for b in names), "a name is a leaf or a branch")
    units = [u.get("name") for u in root.find("UnitDefinitions")]
    rule(len(set(units)) == len(units), "units are unique")
    used = {v.get("unit") for v in variables} - {None}
    rule(used == set(units), f"units used and defined: {used ^ set(units)}")
    for v in variables:
        name, causality, variability = v.get("name"), v.get("causality"), v.get("variability")
        size = 1
        for dimension in v.findall("Dimension"):
            size *= int(dimension.get("start"))
        start = v.get("start") if v.tag != "String" else "".join(s.get("value") + "!" for s in v.findall("Start"))
        needed = causality in ("parameter", "input")
        rule((start is not None) == needed, f"{name}: start")
        if v.tag == "Float64" and needed:
            rule(len(start.split()) in (1, size), f"{name}: {len(start.split())} start values, size {size}")
        allowed = {"parameter": ("fixed",), "calculatedParameter": ("fixed",), "independent": ("continuous",),
                   "input": ("continuous", "discrete"), "output": ("continuous", "discrete")}[causality]
        rule(variability in allowed and (variability != "continuous" or v.tag == "Float64"), f"{name}: variability")
    rule([n for n, v in zip(names, variables) if v.get("causality") == "independent"] == ["time"], "one time")
    structure = root.find("ModelStructure")
    of = {c: {v.get("valueReference") for v in variables if v.get("causality") == c}
          for c in ("output", "calculatedParameter", "parameter")}
    outputs = [e.get("valueReference") for e in structure.findall("Output")]
    unknowns = [e.get("valueReference") for e in structure.findall("InitialUnknown")]
    rule(sorted(outputs) == sorted(of["output"]), "every output is listed once")
    rule(sorted(unknowns) == sorted(of["output"] | of["calculatedParameter"]), "every initial unknown is listed once")
    for element in structure:
        rule(set(element.get("dependencies").split()) <= of["parameter"], "dependencies are knowns")
    return found
