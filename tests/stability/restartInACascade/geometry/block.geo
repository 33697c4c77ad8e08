// Two halves of a bar that part.
SetFactory("OpenCASCADE");
Rectangle(1) = {1, 2, 0, 2, 1};
Rectangle(2) = {3, 2, 0, 2, 1};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
