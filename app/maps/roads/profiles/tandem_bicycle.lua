-- OSRM's own bicycle, which can be told what to avoid.
return require('avoidable')(require('bicycle'))
