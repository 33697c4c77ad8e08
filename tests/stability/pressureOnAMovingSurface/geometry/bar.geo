// A bar as wide as a cell; its upper end carries the pressure.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 2, 0, 0.125, 4};
Physical Surface("bar") = {1};
Physical Curve("top") = {3};
