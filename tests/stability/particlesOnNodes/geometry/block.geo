// A square of ten cells.
SetFactory("OpenCASCADE");
Rectangle(1) = {1.5, 1.5, 0, 5, 5};
Physical Surface("solid") = {1};
