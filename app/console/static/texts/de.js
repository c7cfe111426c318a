/**
 * Die Texte der Konsole auf Deutsch, nach Ansichten wie in en.js.
 *
 * Wortliste (ein Begriff, ein Wort):
 * plan Plan · route Tour · trip Fahrt (vom Depot zum Depot) · stop Stopp · flight, sortie Flug ·
 * truck, van Fahrzeug · drone Drohne · depot Depot · customer Kunde · delivery Zustellung ·
 * pickup Abholung · demand Menge · capacity Ladekapazität · load rate Auslastung ·
 * time window Zeitfenster · shift Schicht · overtime Überstunden · working time Arbeitszeit ·
 * waiting Wartezeit · unassigned nicht eingeplant · cost Kosten · launch Start · recovery
 * Landung · endurance Flugdauer · no-fly area Flugverbotszone · swap Akkuwechsel · remedy Abhilfe ·
 * replan umplanen · driver Fahrer · scenario Szenario · file Datei · import einlesen
 * Anrede: „Sie“, meist vermieden; Schaltflächen im Infinitiv („Datei öffnen“).
 */

export default {
  app: {
    loading: 'Die Konsole wird geladen.',
    starting: 'Der Dienst startet.',
    progress: 'Fortschritt',
    close: 'Schließen',
    more: 'und {{count}} weitere',
  },
  header: {
    language: 'Sprache',
  },
};
