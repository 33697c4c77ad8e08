Include "plate.geo";
