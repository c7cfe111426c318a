-- OSRM's own car, which can be told what to avoid.
return require('avoidable')(require('car'))
