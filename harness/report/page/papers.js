"use strict";
// The papers, by the keys that records have: who wrote them, and what stands in a bibliography.
const PAPERS = {
  creus: {short: "Creus 2010", about: "rain as particles that fall through a city", author: "Creus, Carles", title: "Real-time realistic rain rendering", year: "2010", type: "mastersthesis"},
  stuppacher: {short: "Stuppacher 2007", about: "water drops on panes", author: "Stuppacher, Ines and Supan, Peter", title: "Rendering of Water Drops in Real-Time", year: "2007", type: "inproceedings"},
  chin: {short: "Chin 2016", about: "raindrops that run down a window", author: "Chin, Alina", title: "Animating Raindrops on a Surface", year: "2016", type: "misc"},
  feng: {short: "Feng 2005", about: "rain drawn as a cartoon", author: "Feng, Zhong-Xin and Tang, Min and Dong, Jin-Xiang and Chou, Shang-Ching", title: "Real-time Rain Simulation in Cartoon Style", year: "2005", type: "inproceedings"},
  ye: {short: "Ye", about: "rain as a particle system", author: "Ye, Li-na", title: "Raining Simulation based on Improved Particle Systems algorithms", year: "", type: "inproceedings"},
};
const SOFTWARE = {author: "{raingauge contributors}", title: "raingauge: the rain of published papers on every graphics API", type: "software"};
