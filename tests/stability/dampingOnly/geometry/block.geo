// A block, and a square beside it that nothing touches.
SetFactory("OpenCASCADE");
Rectangle(1) = {1.1, 1.3, 0, 1.5, 1};
Rectangle(2) = {4.85, 5.05, 0, 0.75, 0.5};
Physical Surface("moving") = {1};
Physical Surface("resting") = {2};
