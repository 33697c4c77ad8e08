// A stiff layer on a soft one, as wide as a cell.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.25, 1};
Rectangle(2) = {0, 1, 0, 0.25, 1};
Physical Surface("soft") = {1};
Physical Surface("stiff") = {2};
