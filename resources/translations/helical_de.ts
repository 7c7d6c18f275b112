<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>Helical</name>
    <message>
        <source>Idle</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Rotors start</source>
        <translation>Rotoren laufen an</translation>
    </message>
    <message>
        <source>Lift-off</source>
        <translation>Abheben</translation>
    </message>
    <message>
        <source>Airborne</source>
        <translation>In der Luft</translation>
    </message>
    <message>
        <source>Landing</source>
        <translation>Landung</translation>
    </message>
    <message>
        <source>Touchdown</source>
        <translation>Aufsetzen</translation>
    </message>
    <message>
        <source>Rotors off</source>
        <translation>Rotoren aus</translation>
    </message>
    <message>
        <source>Pose regained</source>
        <translation>Lage wieder bekannt</translation>
    </message>
    <message>
        <source>No pose: coasting on trim</source>
        <translation>Keine Lage: fliegt auf Trimmung weiter</translation>
    </message>
    <message>
        <source>No pose for 0.5 s: open-loop descent</source>
        <translation>Seit 0,5 s keine Lage: blinder Sinkflug</translation>
    </message>
    <message>
        <source>Rotors cut, latched</source>
        <translation>Rotoren abgestellt, endgültig</translation>
    </message>
    <message>
        <source>Helicopter found</source>
        <translation>Hubschrauber gefunden</translation>
    </message>
    <message>
        <source>Take-off refused:</source>
        <translation>Start verweigert:</translation>
    </message>
    <message>
        <source>Output fell back to rotors off: the flight thread was silent</source>
        <translation>Ausgang hat die Rotoren abgestellt: der Flugprozess schwieg</translation>
    </message>
    <message>
        <source>A gust</source>
        <translation>Eine Bö</translation>
    </message>
    <message>
        <source>The disk refuses the record: the flight goes on without one; see the log</source>
        <translation>Die Festplatte verweigert die Aufzeichnung: der Flug geht ohne weiter; siehe das Protokoll</translation>
    </message>
    <message>
        <source>The disk is too slow: the record of this flight has gaps</source>
        <translation>Die Festplatte ist zu langsam: die Aufzeichnung dieses Flugs hat Lücken</translation>
    </message>
    <message>
        <source>The disk is too slow: images are missing in the record</source>
        <translation>Die Festplatte ist zu langsam: in der Aufzeichnung fehlen Bilder</translation>
    </message>
    <message>
        <source>The plan is changed</source>
        <translation>Der Flugplan ist geändert</translation>
    </message>
    <message>
        <source>Gains and trims are changed</source>
        <translation>Verstärkungen und Trimmungen sind geändert</translation>
    </message>
    <message>
        <source>The markers' colour is changed</source>
        <translation>Die Farbe der Marker ist geändert</translation>
    </message>
    <message>
        <source>The cameras take a new background</source>
        <translation>Die Kameras nehmen einen neuen Hintergrund auf</translation>
    </message>
    <message>
        <source>hidden by the operator</source>
        <translation>vom Bediener ausgeblendet</translation>
    </message>
    <message>
        <source>shown again</source>
        <translation>wieder eingeblendet</translation>
    </message>
    <message>
        <source>a white board is held before it</source>
        <translation>eine weiße Tafel wird davor gehalten</translation>
    </message>
    <message>
        <source>a white board is taken away</source>
        <translation>eine weiße Tafel wird weggenommen</translation>
    </message>
    <message>
        <source>loses frames by order</source>
        <translation>verliert auf Befehl Bilder</translation>
    </message>
    <message>
        <source>loses fewer frames by order</source>
        <translation>verliert auf Befehl weniger Bilder</translation>
    </message>
    <message>
        <source>gets noise by order</source>
        <translation>rauscht auf Befehl</translation>
    </message>
    <message>
        <source>gets less noise by order</source>
        <translation>rauscht auf Befehl weniger</translation>
    </message>
    <message>
        <source>knocked by the operator</source>
        <translation>vom Bediener angestoßen</translation>
    </message>
    <message>
        <source>calibrated, in the control set</source>
        <translation>kalibriert, an der Regelung beteiligt</translation>
    </message>
    <message>
        <source>disagrees, out of the control set</source>
        <translation>widerspricht, nicht mehr an der Regelung beteiligt</translation>
    </message>
    <message>
        <source>out of the control set, calibrating</source>
        <translation>nicht mehr an der Regelung beteiligt, kalibriert</translation>
    </message>
    <message>
        <source>the helicopter is not seen</source>
        <translation>der Hubschrauber ist nicht zu sehen</translation>
    </message>
    <message>
        <source>it does not stand on the pad</source>
        <translation>er steht nicht auf dem Landeplatz</translation>
    </message>
    <message>
        <source>it does not stand upright</source>
        <translation>er steht nicht aufrecht</translation>
    </message>
    <message>
        <source>it moves</source>
        <translation>er bewegt sich</translation>
    </message>
    <message>
        <source>calibrates anew by </source>
        <translation>kalibriert neu mit </translation>
    </message>
    <message>
        <source>no new background while the rotors turn</source>
        <translation>kein neuer Hintergrund, solange die Rotoren drehen</translation>
    </message>
    <message>
        <source>land first</source>
        <translation>landen Sie zuerst</translation>
    </message>
    <message>
        <source>there is no calibrator </source>
        <translation>es gibt kein Kalibrierverfahren </translation>
    </message>
    <message>
        <source>take one of the list</source>
        <translation>nehmen Sie eines aus der Liste</translation>
    </message>
    <message>
        <source>Acknowledge</source>
        <translation>Quittieren</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>I have seen it</source>
        <translation>Ich habe es gesehen</translation>
    </message>
    <message>
        <source>Acknowledge the alarm</source>
        <translation>Den Alarm quittieren</translation>
    </message>
    <message>
        <source>   (and %1 more)</source>
        <translation>   (und %1 weitere)</translation>
    </message>
    <message>
        <source>Attitude</source>
        <translation>Fluglage</translation>
    </message>
    <message>
        <source>Roll, pitch and heading of the helicopter as tracked</source>
        <translation>Roll-, Nick- und Gierwinkel des Hubschraubers, wie verfolgt</translation>
    </message>
    <message>
        <source>Roll</source>
        <translation>Rollen</translation>
    </message>
    <message>
        <source>Pitch</source>
        <translation>Nicken</translation>
    </message>
    <message>
        <source>Heading</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Calibration method</source>
        <translation>Kalibrierverfahren</translation>
    </message>
    <message>
        <source>How cameras without a known place find theirs. Another method starts anew from the first guess: the camera leaves the control set until it is admitted again.</source>
        <translation>Wie Kameras ohne bekannten Standort den ihren finden. Ein anderes Verfahren beginnt von der ersten Schätzung an neu: Die Kamera ist nicht an der Regelung beteiligt, bis sie wieder zugelassen wird.</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>No camera is calibrated in flight.</source>
        <translation>Keine Kamera wird im Flug kalibriert.</translation>
    </message>
    <message>
        <source>Restart</source>
        <translation>Neustart</translation>
    </message>
    <message>
        <source>Restart the calibration of %1</source>
        <translation>Die Kalibrierung von %1 neu beginnen</translation>
    </message>
    <message>
        <source>Forget what %1 has learnt and begin again from its first guess</source>
        <translation>Vergessen, was %1 gelernt hat, und von der ersten Schätzung an neu beginnen</translation>
    </message>
    <message>
        <source>sigma</source>
        <translation>Sigma</translation>
    </message>
    <message>
        <source>error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Orientation</source>
        <translation>Ausrichtung</translation>
    </message>
    <message>
        <source>deg</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>Effective</source>
        <translation>Wirksam</translation>
    </message>
    <message>
        <source>Effective sample size of the particles, of all</source>
        <translation>Wirksame Zahl der Partikel, von allen</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>Tafel</translation>
    </message>
    <message>
        <source>Then drag over the picture: a white board covers that part of it. Drag the board to move it, click its cross to take it away.</source>
        <translation>Danach über das Bild ziehen: Eine weiße Tafel verdeckt diesen Teil. Die Tafel lässt sich ziehen; ein Klick auf ihr Kreuz nimmt sie weg.</translation>
    </message>
    <message>
        <source>White board before %1</source>
        <translation>Weiße Tafel vor %1</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Extras</translation>
    </message>
    <message>
        <source>Boards, lost frames, noise, knocks; masks, trails, colour of the markers</source>
        <translation>Tafeln, verlorene Bilder, Rauschen, Stöße; Masken, Spuren, Farbe der Marker</translation>
    </message>
    <message>
        <source>Tools of %1</source>
        <translation>Extras von %1</translation>
    </message>
    <message>
        <source>Picture of %1</source>
        <translation>Bild von %1</translation>
    </message>
    <message>
        <source>no frames</source>
        <translation>keine Bilder</translation>
    </message>
    <message>
        <source>%1 fps</source>
        <translation>%1 B/s</translation>
    </message>
    <message>
        <source>%1 seen  %2 used</source>
        <translation>%1 gesehen  %2 genutzt</translation>
    </message>
    <message>
        <source>nothing new for over 1 s</source>
        <translation>seit über 1 s nichts Neues</translation>
    </message>
    <message>
        <source>  %1 dropped</source>
        <translation>  %1 verloren</translation>
    </message>
    <message>
        <source>  by the cable of %1</source>
        <translation>  über das Kabel von %1</translation>
    </message>
    <message>
        <source>residual %1 px  %2 mm</source>
        <translation>Rest %1 px  %2 mm</translation>
    </message>
    <message>
        <source>Hidden</source>
        <translation>Ausgeblendet</translation>
    </message>
    <message>
        <source> %1 mm</source>
        <translation> %1 mm</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ausbl.</translation>
    </message>
    <message>
        <source>Let the tracker use %1 again</source>
        <translation>%1 wieder für die Verfolgung nutzen</translation>
    </message>
    <message>
        <source>Throw away what %1 sees, as if it were covered</source>
        <translation>Wegwerfen, was %1 sieht, als wäre sie verdeckt</translation>
    </message>
    <message>
        <source>Show %1</source>
        <translation>%1 einblenden</translation>
    </message>
    <message>
        <source>Hide %1</source>
        <translation>%1 ausblenden</translation>
    </message>
    <message>
        <source>Knock lightly (2 deg, 2 cm)</source>
        <translation>Leicht anstoßen (2 Grad, 2 cm)</translation>
    </message>
    <message>
        <source>Knock hard (10 deg, 20 cm)</source>
        <translation>Heftig anstoßen (10 Grad, 20 cm)</translation>
    </message>
    <message>
        <source>Hide from the tracker</source>
        <translation>Vor der Verfolgung verbergen</translation>
    </message>
    <message>
        <source>Draw a white board</source>
        <translation>Eine weiße Tafel zeichnen</translation>
    </message>
    <message>
        <source>Draw a white board by free hand</source>
        <translation>Eine weiße Tafel freihändig zeichnen</translation>
    </message>
    <message>
        <source>Take all boards away</source>
        <translation>Alle Tafeln wegnehmen</translation>
    </message>
    <message>
        <source>Lose frames</source>
        <translation>Bilder verlieren</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>%1 grey levels</source>
        <translation>%1 Graustufen</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>Errors drawn larger</source>
        <translation>Fehler vergrößert zeichnen</translation>
    </message>
    <message>
        <source>%1 times</source>
        <translation>%1-fach</translation>
    </message>
    <message>
        <source>Trails of the markers</source>
        <translation>Spuren der Marker</translation>
    </message>
    <message>
        <source>Background mask</source>
        <translation>Hintergrundmaske</translation>
    </message>
    <message>
        <source>Colour mask</source>
        <translation>Farbmaske</translation>
    </message>
    <message>
        <source>Pick the markers' colour…</source>
        <translation>Farbe der Marker aufnehmen …</translation>
    </message>
    <message>
        <source>%1 x</source>
        <translation>%1 x</translation>
    </message>
    <message>
        <source>Hidden from the tracker</source>
        <translation>Vor der Verfolgung verborgen</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>Colour of the markers</source>
        <translation>Farbe der Marker</translation>
    </message>
    <message>
        <source>Hue from</source>
        <translation>Farbton von</translation>
    </message>
    <message>
        <source>Hue to</source>
        <translation>Farbton bis</translation>
    </message>
    <message>
        <source>Saturation from</source>
        <translation>Sättigung von</translation>
    </message>
    <message>
        <source>Saturation to</source>
        <translation>Sättigung bis</translation>
    </message>
    <message>
        <source>Value from</source>
        <translation>Helligkeit von</translation>
    </message>
    <message>
        <source>Value to</source>
        <translation>Helligkeit bis</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>All cameras look for this colour from now on</source>
        <translation>Alle Kameras suchen ab jetzt diese Farbe</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Back to what was applied before</source>
        <translation>Zurück zu dem, was zuvor galt</translation>
    </message>
    <message>
        <source>Red is 0, green 60, blue 120; from above to wraps through red</source>
        <translation>Rot ist 0, Grün 60, Blau 120; ein „von“ über dem „bis“ läuft durch Rot</translation>
    </message>
    <message>
        <source>0 is grey or black, 255 vivid or bright</source>
        <translation>0 ist grau oder schwarz, 255 kräftig oder hell</translation>
    </message>
    <message>
        <source>Click a ball in a camera's picture. What would be found is tinted.</source>
        <translation>Klicken Sie im Bild einer Kamera auf eine Kugel. Was gefunden würde, ist eingefärbt.</translation>
    </message>
    <message>
        <source>The range of the ball you clicked. Apply it, or change it first.</source>
        <translation>Der Bereich der angeklickten Kugel. Wenden Sie ihn an oder ändern Sie ihn vorher.</translation>
    </message>
    <message>
        <source>There is nothing coloured. Click the middle of a ball; zoom in with the wheel.</source>
        <translation>Dort ist nichts Farbiges. Klicken Sie mitten auf eine Kugel; das Mausrad vergrößert.</translation>
    </message>
    <message>
        <source>New background</source>
        <translation>Neuer Hintergrund</translation>
    </message>
    <message>
        <source>Not changed</source>
        <translation>Nicht geändert</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>What happened, newest at the bottom</source>
        <translation>Was geschah, das Neueste unten</translation>
    </message>
    <message>
        <source>Info</source>
        <translation>Hinweis</translation>
    </message>
    <message>
        <source>Show what is as it should be</source>
        <translation>Zeigen, was ist, wie es soll</translation>
    </message>
    <message>
        <source>Good</source>
        <translation>Gut</translation>
    </message>
    <message>
        <source>Show what became better</source>
        <translation>Zeigen, was besser wurde</translation>
    </message>
    <message>
        <source>Caution</source>
        <translation>Vorsicht</translation>
    </message>
    <message>
        <source>Show what to keep an eye on</source>
        <translation>Zeigen, worauf zu achten ist</translation>
    </message>
    <message>
        <source>Danger</source>
        <translation>Gefahr</translation>
    </message>
    <message>
        <source>Show what needs somebody now</source>
        <translation>Zeigen, was jetzt jemanden braucht</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
    <message>
        <source>Words to filter the events by</source>
        <translation>Wörter, nach denen die Ereignisse gefiltert werden</translation>
    </message>
    <message>
        <source>Only events that have these words</source>
        <translation>Nur Ereignisse mit diesen Wörtern</translation>
    </message>
    <message>
        <source>Flight state</source>
        <translation>Flugzustand</translation>
    </message>
    <message>
        <source>The engine is starting</source>
        <translation>Die Steuerung startet</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Phase</source>
        <translation>Phase</translation>
    </message>
    <message>
        <source>Safety</source>
        <translation>Sicherheit</translation>
    </message>
    <message>
        <source>Failsafes</source>
        <translation>Notverfahren</translation>
    </message>
    <message>
        <source>none acted</source>
        <translation>keines griff ein</translation>
    </message>
    <message>
        <source>now</source>
        <translation>ist</translation>
    </message>
    <message>
        <source>set</source>
        <translation>soll</translation>
    </message>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>Yaw</source>
        <translation>Gieren</translation>
    </message>
    <message>
        <source>Motion</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>Height above pad</source>
        <translation>Höhe über Platz</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>m/s</source>
        <translation>m/s</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Position sigma</source>
        <translation>Sigma der Position</translation>
    </message>
    <message>
        <source>Pose age</source>
        <translation>Alter der Lage</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>Sticks</source>
        <translation>Knüppel</translation>
    </message>
    <message>
        <source>Upper rotor</source>
        <translation>Rotor oben</translation>
    </message>
    <message>
        <source>Lower rotor</source>
        <translation>Rotor unten</translation>
    </message>
    <message>
        <source>Latency</source>
        <translation>Verzögerung</translation>
    </message>
    <message>
        <source>median</source>
        <translation>Median</translation>
    </message>
    <message>
        <source>99 %</source>
        <translation>99 %</translation>
    </message>
    <message>
        <source>Server</source>
        <translation>Rechnen</translation>
    </message>
    <message>
        <source>To command</source>
        <translation>Bis Befehl</translation>
    </message>
    <message>
        <source>Engine time</source>
        <translation>Laufzeit</translation>
    </message>
    <message>
        <source>Coverage and residual maps of %1</source>
        <translation>Karten zu Abdeckung und Rest von %1</translation>
    </message>
    <message>
        <source>Left: where in the image used markers were seen, right: how far off they were there. Right click: save</source>
        <translation>Links: wo im Bild genutzte Marker gesehen wurden, rechts: wie weit sie dort daneben lagen. Rechtsklick: speichern</translation>
    </message>
    <message>
        <source>seen in %1 %</source>
        <translation>gesehen in %1 %</translation>
    </message>
    <message>
        <source>error up to %1 px</source>
        <translation>Fehler bis %1 px</translation>
    </message>
    <message>
        <source>Keys and mouse</source>
        <translation>Tasten und Maus</translation>
    </message>
    <message>
        <source>Flight</source>
        <translation>Flug</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>STOP: rotors off at once, whatever has the focus</source>
        <translation>STOPP: Rotoren sofort aus, wo auch immer der Fokus ist</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>hide or show a camera</source>
        <translation>eine Kamera aus- oder einblenden</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Leertaste</translation>
    </message>
    <message>
        <source>hold the plots still, or follow again</source>
        <translation>die Kurven anhalten oder wieder mitlaufen lassen</translation>
    </message>
    <message>
        <source>this sheet</source>
        <translation>diese Übersicht</translation>
    </message>
    <message>
        <source>full screen</source>
        <translation>Vollbild</translation>
    </message>
    <message>
        <source>Tab</source>
        <translation>Tab</translation>
    </message>
    <message>
        <source>next control; Space presses it</source>
        <translation>nächstes Bedienelement; die Leertaste drückt es</translation>
    </message>
    <message>
        <source>Ctrl+Q</source>
        <translation>Strg+Q</translation>
    </message>
    <message>
        <source>quit</source>
        <translation>beenden</translation>
    </message>
    <message>
        <source>Camera pictures</source>
        <translation>Kamerabilder</translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation>Mausrad</translation>
    </message>
    <message>
        <source>zoom where the mouse is</source>
        <translation>vergrößern, wo die Maus ist</translation>
    </message>
    <message>
        <source>Drag</source>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>move the zoomed picture, or a white board</source>
        <translation>das vergrößerte Bild oder eine weiße Tafel bewegen</translation>
    </message>
    <message>
        <source>Double click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>the whole picture again</source>
        <translation>wieder das ganze Bild</translation>
    </message>
    <message>
        <source>Right click</source>
        <translation>Rechtsklick</translation>
    </message>
    <message>
        <source>boards, lost frames, noise, knocks, masks, trails</source>
        <translation>Tafeln, verlorene Bilder, Rauschen, Stöße, Masken, Spuren</translation>
    </message>
    <message>
        <source>3D scene</source>
        <translation>3D-Szene</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>drehen</translation>
    </message>
    <message>
        <source>Right drag, or Shift and drag</source>
        <translation>Rechts ziehen, oder Umschalt und ziehen</translation>
    </message>
    <message>
        <source>move</source>
        <translation>verschieben</translation>
    </message>
    <message>
        <source>zoom</source>
        <translation>vergrößern</translation>
    </message>
    <message>
        <source>Plots</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>Drag, wheel</source>
        <translation>Ziehen, Mausrad</translation>
    </message>
    <message>
        <source>scroll back, zoom the time</source>
        <translation>zurückblättern, die Zeit vergrößern</translation>
    </message>
    <message>
        <source>back to now</source>
        <translation>zurück zum Jetzt</translation>
    </message>
    <message>
        <source>save as PNG, PDF or CSV</source>
        <translation>als PNG, PDF oder CSV sichern</translation>
    </message>
    <message>
        <source>Latency histogram</source>
        <translation>Histogramm der Verzögerung</translation>
    </message>
    <message>
        <source>From mid-exposure to the use of a frame on the flight thread, over the shown time</source>
        <translation>Von der Mitte der Belichtung bis zur Nutzung eines Bildes im Regeltakt, über die gezeigte Zeit</translation>
    </message>
    <message>
        <source>Latency of the frames</source>
        <translation>Verzögerung der Bilder</translation>
    </message>
    <message>
        <source>No frames in the shown time</source>
        <translation>Keine Bilder in der gezeigten Zeit</translation>
    </message>
    <message>
        <source>median %1  99 % %2 ms</source>
        <translation>Median %1  99 % %2 ms</translation>
    </message>
    <message>
        <source>&amp;Flight</source>
        <translation>&amp;Flug</translation>
    </message>
    <message>
        <source>&amp;Cameras</source>
        <translation>&amp;Kameras</translation>
    </message>
    <message>
        <source>&amp;Disturb</source>
        <translation>&amp;Stören</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>About Helical</source>
        <translation>Über Helical</translation>
    </message>
    <message>
        <source>Take off</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Land</source>
        <translation>Landen</translation>
    </message>
    <message>
        <source>STOP	Esc</source>
        <translation>STOPP	Esc</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Take a new background</source>
        <translation>Neuen Hintergrund aufnehmen</translation>
    </message>
    <message>
        <source>Colour of the markers…</source>
        <translation>Farbe der Marker …</translation>
    </message>
    <message>
        <source>Light gust (0.8 m/s)</source>
        <translation>Leichte Bö (0,8 m/s)</translation>
    </message>
    <message>
        <source>Strong gust (2 m/s)</source>
        <translation>Starke Bö (2 m/s)</translation>
    </message>
    <message>
        <source>Layout: Fly</source>
        <translation>Anordnung: Fliegen</translation>
    </message>
    <message>
        <source>Layout: Calibrate</source>
        <translation>Anordnung: Kalibrieren</translation>
    </message>
    <message>
        <source>Layout: Analyse</source>
        <translation>Anordnung: Auswerten</translation>
    </message>
    <message>
        <source>Border of what two cameras see</source>
        <translation>Grenze dessen, was zwei Kameras sehen</translation>
    </message>
    <message>
        <source>Pause the plots</source>
        <translation>Kurven anhalten</translation>
    </message>
    <message>
        <source>Light theme</source>
        <translation>Helle Darstellung</translation>
    </message>
    <message>
        <source>Sound of alarms</source>
        <translation>Ton bei Alarmen</translation>
    </message>
    <message>
        <source>Full screen</source>
        <translation>Vollbild</translation>
    </message>
    <message>
        <source>Helical Ground Control</source>
        <translation>Helical Bodenstation</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>Gains</source>
        <translation>Regler</translation>
    </message>
    <message>
        <source>Follow</source>
        <translation>Folgen</translation>
    </message>
    <message>
        <source>The eye goes with the helicopter</source>
        <translation>Das Auge geht mit dem Hubschrauber mit</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>From above, +x to the right</source>
        <translation>Von oben, +x nach rechts</translation>
    </message>
    <message>
        <source>Iso</source>
        <translation>Iso</translation>
    </message>
    <message>
        <source>All of the field, from the side</source>
        <translation>Das ganze Feld, von der Seite</translation>
    </message>
    <message>
        <source>%1 view</source>
        <translation>Ansicht %1</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Through a camera, from where it is believed to stand</source>
        <translation>Durch eine Kamera, von da, wo sie vermutet wird</translation>
    </message>
    <message>
        <source>View through a camera</source>
        <translation>Blick durch eine Kamera</translation>
    </message>
    <message>
        <source>Through %1</source>
        <translation>Durch %1</translation>
    </message>
    <message>
        <source>&lt;b&gt;Helical&lt;/b&gt;&lt;br&gt;Ground control for small helicopters that carry no sensors.&lt;br&gt;&lt;br&gt;GPL-3.0-or-later</source>
        <translation>&lt;b&gt;Helical&lt;/b&gt;&lt;br&gt;Bodenstation für kleine Hubschrauber ohne Sensoren.&lt;br&gt;&lt;br&gt;GPL-3.0-or-later</translation>
    </message>
    <message>
        <source>Starting the engine</source>
        <translation>Die Steuerung startet</translation>
    </message>
    <message>
        <source>Newest event</source>
        <translation>Neuestes Ereignis</translation>
    </message>
    <message>
        <source>Load of this window</source>
        <translation>Last dieses Fensters</translation>
    </message>
    <message>
        <source>Refreshes of this window, time to draw the 3D scene, engine ticks the window was too slow for</source>
        <translation>Auffrischungen dieses Fensters, Zeit zum Zeichnen der 3D-Szene, Takte der Steuerung, für die das Fenster zu langsam war</translation>
    </message>
    <message>
        <source>GUI %1 Hz   3D %2 ms   lost ticks %3</source>
        <translation>Fenster %1 Hz   3D %2 ms   verlorene Takte %3</translation>
    </message>
    <message>
        <source>%1 Hz</source>
        <translation>%1 Hz</translation>
    </message>
    <message>
        <source>Flight plan</source>
        <translation>Flugplan</translation>
    </message>
    <message>
        <source>x
m</source>
        <translation>x
m</translation>
    </message>
    <message>
        <source>y
m</source>
        <translation>y
m</translation>
    </message>
    <message>
        <source>height
m</source>
        <translation>Höhe
m</translation>
    </message>
    <message>
        <source>yaw
deg</source>
        <translation>Gier
Grad</translation>
    </message>
    <message>
        <source>hold
s</source>
        <translation>Halt
s</translation>
    </message>
    <message>
        <source>speed
m/s</source>
        <translation>Tempo
m/s</translation>
    </message>
    <message>
        <source>Waypoints</source>
        <translation>Wegpunkte</translation>
    </message>
    <message>
        <source>Places relative to the pad; the first is the take-off height. They can be dragged in the 3D scene, too.</source>
        <translation>Orte bezogen auf den Landeplatz; der erste ist die Starthöhe. Sie lassen sich auch in der 3D-Szene ziehen.</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Neu</translation>
    </message>
    <message>
        <source>One more waypoint behind the selected one</source>
        <translation>Noch ein Wegpunkt hinter dem gewählten</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>Take the selected waypoint out</source>
        <translation>Den gewählten Wegpunkt herausnehmen</translation>
    </message>
    <message>
        <source>Climb</source>
        <translation>Steigen</translation>
    </message>
    <message>
        <source>Speed up to the first waypoint</source>
        <translation>Tempo hinauf zum ersten Wegpunkt</translation>
    </message>
    <message>
        <source>Descent</source>
        <translation>Sinken</translation>
    </message>
    <message>
        <source>Speed down when it lands</source>
        <translation>Tempo hinab bei der Landung</translation>
    </message>
    <message>
        <source>Speed down within 12 cm of the ground; at most the descent speed</source>
        <translation>Tempo hinab ab 12 cm über dem Boden; höchstens so schnell wie das Sinken</translation>
    </message>
    <message>
        <source>Land after</source>
        <translation>Landen nach</translation>
    </message>
    <message>
        <source>s</source>
        <translation>s</translation>
    </message>
    <message>
        <source>Of flight time; 0: after the last waypoint's hold</source>
        <translation>Flugzeit; 0: nach dem Halt am letzten Wegpunkt</translation>
    </message>
    <message>
        <source>What is wrong with the plan</source>
        <translation>Was am Plan nicht stimmt</translation>
    </message>
    <message>
        <source>Revert</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Back to the plan in force</source>
        <translation>Zurück zum geltenden Plan</translation>
    </message>
    <message>
        <source>Fly this plan: all changes at one control tick</source>
        <translation>Diesen Plan fliegen: alle Änderungen in einem Regeltakt</translation>
    </message>
    <message>
        <source>Plan: %1</source>
        <translation>Plan: %1</translation>
    </message>
    <message>
        <source>How long the frames were on their way</source>
        <translation>Wie lange die Bilder unterwegs waren</translation>
    </message>
    <message>
        <source>%1 plots</source>
        <translation>Kurven: %1</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Follow the newest values, or stand still (Space). Drag a plot to scroll back, turn the wheel to zoom, double click to follow again.</source>
        <translation>Den neuesten Werten folgen oder stehen bleiben (Leertaste). Ziehen blättert zurück, das Mausrad vergrößert, ein Doppelklick folgt wieder.</translation>
    </message>
    <message>
        <source>Live plots</source>
        <translation>Kurven mitlaufen lassen</translation>
    </message>
    <message>
        <source>set-point</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>tracked</source>
        <translation>verfolgt</translation>
    </message>
    <message>
        <source>bound</source>
        <translation>Schranke</translation>
    </message>
    <message>
        <source>Reprojection residual</source>
        <translation>Rückprojektionsrest</translation>
    </message>
    <message>
        <source>px</source>
        <translation>px</translation>
    </message>
    <message>
        <source>Position and heading of the helicopter with their references</source>
        <translation>Position und Richtung des Hubschraubers mit ihren Sollwerten</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>Z</source>
        <translation>Z</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y</translation>
    </message>
    <message>
        <source>Tracking</source>
        <translation>Verfolgung</translation>
    </message>
    <message>
        <source>How well the helicopter is known, what is sent to it, how long that takes</source>
        <translation>Wie gut der Hubschrauber bekannt ist, was an ihn gesendet wird, wie lange das dauert</translation>
    </message>
    <message>
        <source>Helicopter position</source>
        <translation>Position des Hubschraubers</translation>
    </message>
    <message>
        <source>%</source>
        <translation>%</translation>
    </message>
    <message>
        <source>upper</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>lower</source>
        <translation>unten</translation>
    </message>
    <message>
        <source>roll</source>
        <translation>Rollen</translation>
    </message>
    <message>
        <source>pitch</source>
        <translation>Nicken</translation>
    </message>
    <message>
        <source>Latency (99 %)</source>
        <translation>Verzögerung (99 %)</translation>
    </message>
    <message>
        <source>server</source>
        <translation>Rechnen</translation>
    </message>
    <message>
        <source>frame to command</source>
        <translation>Bild bis Befehl</translation>
    </message>
    <message>
        <source>How the cameras without a known place find theirs</source>
        <translation>Wie die Kameras ohne bekannten Standort den ihren finden</translation>
    </message>
    <message>
        <source>No camera of this rig is calibrated in flight.</source>
        <translation>Keine Kamera dieses Aufbaus wird im Flug kalibriert.</translation>
    </message>
    <message>
        <source>Effective sample size</source>
        <translation>Wirksame Zahl der Partikel</translation>
    </message>
    <message>
        <source>Camera position</source>
        <translation>Position der Kamera</translation>
    </message>
    <message>
        <source>Camera orientation</source>
        <translation>Ausrichtung der Kamera</translation>
    </message>
    <message>
        <source>Features</source>
        <translation>Merkmale</translation>
    </message>
    <message>
        <source>Which markers of which camera the pose was found from</source>
        <translation>Aus welchen Markern welcher Kamera die Lage bestimmt wurde</translation>
    </message>
    <message>
        <source>Selected features</source>
        <translation>Genutzte Merkmale</translation>
    </message>
    <message>
        <source>Helicopter</source>
        <translation>Hubschrauber</translation>
    </message>
    <message>
        <source>the flight is over; start Helical anew for another one</source>
        <translation>der Flug ist vorbei; starten Sie Helical neu für einen weiteren</translation>
    </message>
    <message>
        <source>seen, still, on the pad</source>
        <translation>gesehen, still, auf dem Platz</translation>
    </message>
    <message>
        <source>Pose</source>
        <translation>Lage</translation>
    </message>
    <message>
        <source>not known: show the markers to two calibrated cameras</source>
        <translation>unbekannt: zeigen Sie die Marker zwei kalibrierten Kameras</translation>
    </message>
    <message>
        <source>sigma %1 mm</source>
        <translation>Sigma %1 mm</translation>
    </message>
    <message>
        <source>%1: uncertain</source>
        <translation>%1: unsicher</translation>
    </message>
    <message>
        <source>%1 of %2 help the pose</source>
        <translation>%1 von %2 helfen der Lage</translation>
    </message>
    <message>
        <source>Control set</source>
        <translation>Regelung</translation>
    </message>
    <message>
        <source>%1: nothing is left if it is covered</source>
        <translation>%1: nichts bleibt, wenn sie verdeckt wird</translation>
    </message>
    <message>
        <source>no frames: look at its cable and at `helical doctor`</source>
        <translation>keine Bilder: prüfen Sie das Kabel und `helical doctor`</translation>
    </message>
    <message>
        <source>a white board is before it</source>
        <translation>eine weiße Tafel ist davor</translation>
    </message>
    <message>
        <source>un-calibrated, not used</source>
        <translation>nicht kalibriert, nicht genutzt</translation>
    </message>
    <message>
        <source>calibrating: joins in flight</source>
        <translation>kalibriert: kommt im Flug dazu</translation>
    </message>
    <message>
        <source>disagrees with the others: was it knocked?</source>
        <translation>widerspricht den anderen: wurde sie angestoßen?</translation>
    </message>
    <message>
        <source>only %1</source>
        <translation>nur %1</translation>
    </message>
    <message>
        <source>%1 frames dropped</source>
        <translation>%1 Bilder verloren</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>%1 of %2 ms used</source>
        <translation>%1 von %2 ms genutzt</translation>
    </message>
    <message>
        <source>Flight thread</source>
        <translation>Regeltakt</translation>
    </message>
    <message>
        <source>%1: close other programs</source>
        <translation>%1: schließen Sie andere Programme</translation>
    </message>
    <message>
        <source>rotors cut, latched; start Helical anew</source>
        <translation>Rotoren abgestellt, endgültig; starten Sie Helical neu</translation>
    </message>
    <message>
        <source>normal</source>
        <translation>normal</translation>
    </message>
    <message>
        <source>Pre-flight list</source>
        <translation>Checkliste vor dem Flug</translation>
    </message>
    <message>
        <source>Drag: turn.  Right drag or Shift and drag: move.  Wheel: zoom.  Drag a waypoint over the ground, with Ctrl up and down.</source>
        <translation>Ziehen: drehen.  Rechts ziehen oder Umschalt und ziehen: verschieben.  Mausrad: vergrößern.  Wegpunkte lassen sich über den Boden ziehen, mit Strg auf und ab.</translation>
    </message>
    <message>
        <source>The 3D view needs OpenGL 3.2</source>
        <translation>Die 3D-Ansicht braucht OpenGL 3.2</translation>
    </message>
    <message>
        <source>Starting the 3D view</source>
        <translation>Die 3D-Ansicht startet</translation>
    </message>
    <message>
        <source>%1: place not known yet</source>
        <translation>%1: Standort noch unbekannt</translation>
    </message>
    <message>
        <source>Un-calibrated</source>
        <translation>Nicht kalibriert</translation>
    </message>
    <message>
        <source>Calibrating</source>
        <translation>Kalibriert noch</translation>
    </message>
    <message>
        <source>Calibrated</source>
        <translation>Kalibriert</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Verworfen</translation>
    </message>
    <message>
        <source>Needs two others</source>
        <translation>Braucht zwei andere</translation>
    </message>
    <message>
        <source>On the pad</source>
        <translation>Auf dem Platz</translation>
    </message>
    <message>
        <source>Spin-up</source>
        <translation>Anlauf</translation>
    </message>
    <message>
        <source>Take-off</source>
        <translation>Start</translation>
    </message>
    <message>
        <source>Flying</source>
        <translation>Flug</translation>
    </message>
    <message>
        <source>Normal</source>
        <translation>Normal</translation>
    </message>
    <message>
        <source>Coasting</source>
        <translation>Trimmflug</translation>
    </message>
    <message>
        <source>Descending</source>
        <translation>Sinkflug</translation>
    </message>
    <message>
        <source>Land now</source>
        <translation>Landet jetzt</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Abgestellt</translation>
    </message>
    <message>
        <source>Landed</source>
        <translation>Gelandet</translation>
    </message>
    <message>
        <source>Not ready</source>
        <translation>Nicht bereit</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>No pose</source>
        <translation>Keine Lage</translation>
    </message>
    <message>
        <source>coast</source>
        <translation>Trimmflug</translation>
    </message>
    <message>
        <source>descent</source>
        <translation>Sinkflug</translation>
    </message>
    <message>
        <source>no-pose cut</source>
        <translation>abgestellt ohne Lage</translation>
    </message>
    <message>
        <source>tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>fence</source>
        <translation>Zaun</translation>
    </message>
    <message>
        <source>hard fence</source>
        <translation>äußerer Zaun</translation>
    </message>
    <message>
        <source>flight time</source>
        <translation>Flugzeit</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>STOPP</translation>
    </message>
    <message>
        <source>lift-off failed</source>
        <translation>Abheben misslungen</translation>
    </message>
    <message>
        <source>Plots: %1</source>
        <translation>Kurven: %1</translation>
    </message>
    <message>
        <source>%1 covered</source>
        <translation>%1 verdeckt</translation>
    </message>
    <message>
        <source>%1 disturbed</source>
        <translation>%1 gestört</translation>
    </message>
    <message>
        <source>%1 knocked</source>
        <translation>%1 angestoßen</translation>
    </message>
    <message>
        <source>gust</source>
        <translation>Bö</translation>
    </message>
    <message>
        <source>Save as %1…</source>
        <translation>Sichern als %1 …</translation>
    </message>
    <message>
        <source>Save the plots</source>
        <translation>Die Kurven sichern</translation>
    </message>
    <message>
        <source>%1 cannot be written. Choose another folder.</source>
        <translation>%1 lässt sich nicht schreiben. Wählen Sie einen anderen Ordner.</translation>
    </message>
    <message>
        <source>Starting</source>
        <translation>Startet</translation>
    </message>
    <message>
        <source>Click for the pre-flight list</source>
        <translation>Klick für die Checkliste vor dem Flug</translation>
    </message>
    <message>
        <source>Readiness</source>
        <translation>Bereitschaft</translation>
    </message>
    <message>
        <source>Tracked</source>
        <translation>Verfolgt</translation>
    </message>
    <message>
        <source>Cameras that help the pose now, of all in the rig</source>
        <translation>Kameras, die jetzt der Lage helfen, von allen des Aufbaus</translation>
    </message>
    <message>
        <source>Engine</source>
        <translation>Takt</translation>
    </message>
    <message>
        <source>Control ticks per second</source>
        <translation>Regeltakte je Sekunde</translation>
    </message>
    <message>
        <source>Since the rotors started</source>
        <translation>Seit die Rotoren anliefen</translation>
    </message>
    <message>
        <source>Ground Control</source>
        <translation>Bodenstation</translation>
    </message>
    <message>
        <source>Start the flight plan; the readiness word tells what is missing</source>
        <translation>Den Flugplan beginnen; das Wort zur Bereitschaft sagt, was fehlt</translation>
    </message>
    <message>
        <source>Land where it is</source>
        <translation>Landen, wo er ist</translation>
    </message>
    <message>
        <source>STOP</source>
        <translation>STOPP</translation>
    </message>
    <message>
        <source>Rotors off at once (Esc). It falls from where it is, and stays off.</source>
        <translation>Rotoren sofort aus (Esc). Er fällt, wo er ist, und bleibt aus.</translation>
    </message>
    <message>
        <source>Simulation</source>
        <translation>Simulation</translation>
    </message>
    <message>
        <source>Position P</source>
        <translation>Position P</translation>
    </message>
    <message>
        <source>Position D</source>
        <translation>Position D</translation>
    </message>
    <message>
        <source>Position I</source>
        <translation>Position I</translation>
    </message>
    <message>
        <source>Position I limit</source>
        <translation>Grenze Position I</translation>
    </message>
    <message>
        <source>Position error limit</source>
        <translation>Grenze Positionsfehler</translation>
    </message>
    <message>
        <source>Swash plate phase</source>
        <translation>Phase der Taumelscheibe</translation>
    </message>
    <message>
        <source>Height P</source>
        <translation>Höhe P</translation>
    </message>
    <message>
        <source>Height D</source>
        <translation>Höhe D</translation>
    </message>
    <message>
        <source>Height I</source>
        <translation>Höhe I</translation>
    </message>
    <message>
        <source>Yaw P</source>
        <translation>Gieren P</translation>
    </message>
    <message>
        <source>Yaw rate limit</source>
        <translation>Grenze Drehrate</translation>
    </message>
    <message>
        <source>Yaw D</source>
        <translation>Gieren D</translation>
    </message>
    <message>
        <source>Yaw I</source>
        <translation>Gieren I</translation>
    </message>
    <message>
        <source>Trim upper rotor</source>
        <translation>Trimmung Rotor oben</translation>
    </message>
    <message>
        <source>Trim lower rotor</source>
        <translation>Trimmung Rotor unten</translation>
    </message>
    <message>
        <source>Trim roll</source>
        <translation>Trimmung Rollen</translation>
    </message>
    <message>
        <source>Trim pitch</source>
        <translation>Trimmung Nicken</translation>
    </message>
    <message>
        <source>Gains and trims</source>
        <translation>Verstärkungen und Trimmungen</translation>
    </message>
    <message>
        <source>Gains: %1</source>
        <translation>Regler: %1</translation>
    </message>
    <message>
        <source>Rig's</source>
        <translation>Vorgabe</translation>
    </message>
    <message>
        <source>The values of the rig file</source>
        <translation>Die Werte der Aufbaudatei</translation>
    </message>
    <message>
        <source>Back to what is in force</source>
        <translation>Zurück zu dem, was gilt</translation>
    </message>
    <message>
        <source>All changes at one control tick</source>
        <translation>Alle Änderungen in einem Regeltakt</translation>
    </message>
    <message>
        <source>Safe from %1 to %2; the rig has %3</source>
        <translation>Sicher von %1 bis %2; der Aufbau hat %3</translation>
    </message>
    <message>
        <source>Armed: the rotors may turn</source>
        <translation>Scharf: die Rotoren dürfen drehen</translation>
    </message>
    <message>
        <source>Disarmed</source>
        <translation>Gesichert</translation>
    </message>
    <message>
        <source>Holds where it is</source>
        <translation>Hält, wo er ist</translation>
    </message>
    <message>
        <source>Hold ended</source>
        <translation>Halten beendet</translation>
    </message>
    <message>
        <source>The descent is over: rotors cut</source>
        <translation>Der Sinkflug ist vorbei: Rotoren abgestellt</translation>
    </message>
    <message>
        <source>Tilted too far: rotors cut</source>
        <translation>Zu weit geneigt: Rotoren abgestellt</translation>
    </message>
    <message>
        <source>Outside the fence: lands where it is</source>
        <translation>Außerhalb des Zauns: landet, wo er ist</translation>
    </message>
    <message>
        <source>Far outside the fence: rotors cut</source>
        <translation>Weit außerhalb des Zauns: Rotoren abgestellt</translation>
    </message>
    <message>
        <source>The flight time is over: lands</source>
        <translation>Die Flugzeit ist um: landet</translation>
    </message>
    <message>
        <source>STOP: rotors cut, latched</source>
        <translation>STOPP: Rotoren abgestellt, endgültig</translation>
    </message>
    <message>
        <source>It does not lift off: rotors cut</source>
        <translation>Er hebt nicht ab: Rotoren abgestellt</translation>
    </message>
    <message>
        <source>No pose: neutral sticks</source>
        <translation>Keine Lage: neutrale Knüppel</translation>
    </message>
    <message>
        <source>No calibrated camera is left: neutral sticks</source>
        <translation>Keine kalibrierte Kamera übrig: neutrale Knüppel</translation>
    </message>
    <message>
        <source>The pose is doubtful: holds</source>
        <translation>Die Lage ist zweifelhaft: hält</translation>
    </message>
    <message>
        <source>The pose stays doubtful: lands</source>
        <translation>Die Lage bleibt zweifelhaft: landet</translation>
    </message>
    <message>
        <source>Too fast: lands where it is</source>
        <translation>Zu schnell: landet, wo er ist</translation>
    </message>
    <message>
        <source>The transmitter is gone: output cut, fly by hand</source>
        <translation>Der Sender ist weg: Ausgang getrennt, von Hand fliegen</translation>
    </message>
    <message>
        <source>The transmitter does not answer: lands as soon as it does, fly by hand</source>
        <translation>Der Sender antwortet nicht: landet, sobald er es tut, von Hand fliegen</translation>
    </message>
    <message>
        <source>The transmitter has not answered for long: output cut, fly by hand</source>
        <translation>Der Sender antwortet lange nicht: Ausgang getrennt, von Hand fliegen</translation>
    </message>
    <message>
        <source>Near the fence: pushed back</source>
        <translation>Nahe am Zaun: zurückgedrängt</translation>
    </message>
    <message>
        <source>Nine tenths of the flight time are over</source>
        <translation>Neun Zehntel der Flugzeit sind um</translation>
    </message>
    <message>
        <source>A camera is silent</source>
        <translation>Eine Kamera schweigt</translation>
    </message>
    <message>
        <source>A camera's clock is off</source>
        <translation>Die Uhr einer Kamera geht falsch</translation>
    </message>
    <message>
        <source>The flight thread is late</source>
        <translation>Der Regeltakt kommt zu spät</translation>
    </message>
    <message>
        <source>The transmitter does not take a demand</source>
        <translation>Der Sender nimmt keinen Befehl an</translation>
    </message>
    <message>
        <source>The pilot's transmitter flies</source>
        <translation>Der Sender des Piloten fliegt</translation>
    </message>
    <message>
        <source>The record of the flight has stopped</source>
        <translation>Die Aufzeichnung des Flugs ist stehengeblieben</translation>
    </message>
    <message>
        <source>the rotors were cut; start Helical anew</source>
        <translation>die Rotoren wurden abgestellt; starten Sie Helical neu</translation>
    </message>
    <message>
        <source>it is outside the fence</source>
        <translation>er ist außerhalb des Zauns</translation>
    </message>
    <message>
        <source>too few calibrated cameras give frames</source>
        <translation>zu wenige kalibrierte Kameras liefern Bilder</translation>
    </message>
    <message>
        <source>a camera loses frames</source>
        <translation>eine Kamera verliert Bilder</translation>
    </message>
    <message>
        <source>the cameras disagree about the pose</source>
        <translation>die Kameras sind über die Lage uneins</translation>
    </message>
    <message>
        <source>the pose is too uncertain</source>
        <translation>die Lage ist zu unsicher</translation>
    </message>
    <message>
        <source>the nose does not point along the pad: which way it stands is ambiguous</source>
        <translation>die Nase zeigt nicht längs des Platzes: wie er steht, ist mehrdeutig</translation>
    </message>
    <message>
        <source>the transmitter is not ready</source>
        <translation>der Sender ist nicht bereit</translation>
    </message>
    <message>
        <source>the channels of the transmitter are not calibrated, or nobody has looked which way they go</source>
        <translation>die Kanäle des Senders sind nicht kalibriert, oder niemand hat nachgesehen, in welche Richtung sie gehen</translation>
    </message>
    <message>
        <source>the pilot's transmitter flies</source>
        <translation>der Sender des Piloten fliegt</translation>
    </message>
    <message>
        <source>the sticks are not at zero</source>
        <translation>die Knüppel stehen nicht auf null</translation>
    </message>
    <message>
        <source>the record of the flight has stopped</source>
        <translation>die Aufzeichnung des Flugs ist stehengeblieben</translation>
    </message>
    <message>
        <source>the disk for the record is almost full</source>
        <translation>die Festplatte für die Aufzeichnung ist fast voll</translation>
    </message>
    <message>
        <source>the machine is too busy for the control rate</source>
        <translation>der Rechner ist zu beschäftigt für den Regeltakt</translation>
    </message>
    <message>
        <source>Holding</source>
        <translation>Hält</translation>
    </message>
    <message>
        <source>Neutral</source>
        <translation>Neutral</translation>
    </message>
    <message>
        <source>neutral</source>
        <translation>neutral</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>keine Kamera</translation>
    </message>
    <message>
        <source>doubtful pose</source>
        <translation>zweifelhafte Lage</translation>
    </message>
    <message>
        <source>Two cameras have changed cables: each is taken for the other one now</source>
        <translation>Zwei Kameras haben die Kabel getauscht: jede gilt jetzt als die andere</translation>
    </message>
    <message>
        <source>transmitter: landed</source>
        <translation>Sender: gelandet</translation>
    </message>
    <message>
        <source>transmitter: cut</source>
        <translation>Sender: getrennt</translation>
    </message>
    <message>
        <source>doubtful pose: landed</source>
        <translation>zweifelhafte Lage: gelandet</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>transmitter</source>
        <translation>Sender</translation>
    </message>
    <message>
        <source>Arm</source>
        <translation>Scharf</translation>
    </message>
    <message>
        <source>Allow the rotors to turn, or forbid it again</source>
        <translation>Den Rotoren erlauben zu drehen, oder es wieder verbieten</translation>
    </message>
    <message>
        <source>Disarm</source>
        <translation>Sichern</translation>
    </message>
    <message>
        <source>the engine is still busy with earlier orders</source>
        <translation>die Steuerung ist noch mit früheren Befehlen beschäftigt</translation>
    </message>
    <message>
        <source>try again</source>
        <translation>versuchen Sie es noch einmal</translation>
    </message>
    <message>
        <source>%1 - recorded flight</source>
        <translation>%1 – aufgezeichneter Flug</translation>
    </message>
    <message>
        <source>F&amp;ile</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>Open session...</source>
        <translation>Aufzeichnung öffnen …</translation>
    </message>
    <message>
        <source>Open a recorded flight</source>
        <translation>Einen aufgezeichneten Flug öffnen</translation>
    </message>
    <message>
        <source>Sessions (*.mcap)</source>
        <translation>Aufzeichnungen (*.mcap)</translation>
    </message>
    <message>
        <source>A tick back</source>
        <translation>Einen Takt zurück</translation>
    </message>
    <message>
        <source>Play or pause</source>
        <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
        <source>A tick forth</source>
        <translation>Einen Takt vor</translation>
    </message>
    <message>
        <source>The loop begins here; again: no loop</source>
        <translation>Die Schleife beginnt hier; nochmals: keine Schleife</translation>
    </message>
    <message>
        <source>The loop ends here; again: no loop</source>
        <translation>Die Schleife endet hier; nochmals: keine Schleife</translation>
    </message>
    <message>
        <source>Time line</source>
        <translation>Zeitleiste</translation>
    </message>
    <message>
        <source>sends no frame any more, looked for again</source>
        <translation>sendet kein Bild mehr, wird wieder gesucht</translation>
    </message>
    <message>
        <source>its recording has ended</source>
        <translation>die Aufnahme ist zu Ende</translation>
    </message>
    <message>
        <source>its recording is damaged: see the log</source>
        <translation>die Aufnahme ist beschädigt: siehe Protokoll</translation>
    </message>
    <message>
        <source>controlled by another host</source>
        <translation>von einem anderen Rechner gesteuert</translation>
    </message>
    <message>
        <source>does not answer: cable or power?</source>
        <translation>antwortet nicht: Kabel oder Strom?</translation>
    </message>
    <message>
        <source>is back, with its settings</source>
        <translation>ist zurück, mit ihren Einstellungen</translation>
    </message>
    <message>
        <source>Two cameras disagree: one was moved, and which one is not known</source>
        <translation>Zwei Kameras widersprechen sich: eine wurde bewegt, welche ist unbekannt</translation>
    </message>
    <message>
        <source>Comparison of %n flight(s)</source>
        <translation>Vergleich von %n Flügen</translation>
    </message>
    <message>
        <source>Which plots</source>
        <translation>Welche Diagramme</translation>
    </message>
    <message>
        <source>Save as PDF...</source>
        <translation>Als PDF speichern...</translation>
    </message>
    <message>
        <source>Plots of the flights</source>
        <translation>Diagramme der Flüge</translation>
    </message>
    <message>
        <source>Save the comparison</source>
        <translation>Vergleich speichern</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>The flights side by side</source>
        <translation>Die Flüge nebeneinander</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Tables (CSV), one of each stream</source>
        <translation>Tabellen (CSV), je Datenstrom eine</translation>
    </message>
    <message>
        <source>Figures as pictures (PNG)</source>
        <translation>Abbildungen als Bilder (PNG)</translation>
    </message>
    <message>
        <source>Figures and a report (PDF)</source>
        <translation>Abbildungen und ein Bericht (PDF)</translation>
    </message>
    <message>
        <source>Films of the cameras with what was found in them (MP4)</source>
        <translation>Filme der Kameras mit dem, was darin gefunden wurde (MP4)</translation>
    </message>
    <message>
        <source>The session holds no images of the cameras</source>
        <translation>Die Aufzeichnung enthält keine Kamerabilder</translation>
    </message>
    <message>
        <source>Film of the 3D view (MP4)</source>
        <translation>Film der 3D-Ansicht (MP4)</translation>
    </message>
    <message>
        <source>Streams of the tables</source>
        <translation>Datenströme der Tabellen</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Bis</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Choose...</source>
        <translation>Wählen...</translation>
    </message>
    <message>
        <source>Folder for the files</source>
        <translation>Ordner für die Dateien</translation>
    </message>
    <message>
        <source>Progress of the export</source>
        <translation>Fortschritt des Exports</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Export session...</source>
        <translation>Aufzeichnung exportieren...</translation>
    </message>
    <message>
        <source>Record the cameras' pictures</source>
        <translation>Bilder der Kameras aufzeichnen</translation>
    </message>
    <message>
        <source>Panel in a window of its own</source>
        <translation>Bereich in eigenem Fenster</translation>
    </message>
    <message>
        <source>Ctrl+R</source>
        <translation>Strg+R</translation>
    </message>
    <message>
        <source>record the cameras' pictures, or no more</source>
        <translation>Bilder der Kameras aufzeichnen, oder nicht mehr</translation>
    </message>
    <message>
        <source>Record of this flight</source>
        <translation>Aufzeichnung dieses Flugs</translation>
    </message>
    <message>
        <source>Everything but pictures is recorded from the start to the folder of sessions; Ctrl+R adds the cameras' pictures</source>
        <translation>Alles außer den Bildern wird von Anfang an in den Aufzeichnungsordner geschrieben; mit Strg+R auch die Bilder der Kameras</translation>
    </message>
    <message>
        <source>not recorded</source>
        <translation>nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>▲ the record is cut off</source>
        <translation>▲ die Aufzeichnung ist abgebrochen</translation>
    </message>
    <message>
        <source>● recorded with pictures</source>
        <translation>● mit Bildern aufgezeichnet</translation>
    </message>
    <message>
        <source>● recorded</source>
        <translation>● aufgezeichnet</translation>
    </message>
    <message>
        <source>, %1 GB left</source>
        <translation>, noch %1 GB frei</translation>
    </message>
    <message>
        <source>Compare sessions...</source>
        <translation>Aufzeichnungen vergleichen...</translation>
    </message>
    <message>
        <source>Export a recorded flight</source>
        <translation>Einen aufgezeichneten Flug exportieren</translation>
    </message>
    <message>
        <source>Compare recorded flights</source>
        <translation>Aufgezeichnete Flüge vergleichen</translation>
    </message>
    <message>
        <source>Compare this flight with others</source>
        <translation>Diesen Flug mit anderen vergleichen</translation>
    </message>
    <message>
        <source>the session holds no picture in this span</source>
        <translation>die Aufzeichnung enthält in dieser Zeit kein Bild</translation>
    </message>
    <message>
        <source>the 3D view needs OpenGL 3.2</source>
        <translation>die 3D-Ansicht braucht OpenGL 3.2</translation>
    </message>
    <message>
        <source>The session cannot be exported</source>
        <translation>Die Aufzeichnung lässt sich nicht exportieren</translation>
    </message>
    <message>
        <source>Compare sessions</source>
        <translation>Aufzeichnungen vergleichen</translation>
    </message>
    <message>
        <source>Choose two sessions or more.</source>
        <translation>Bitte zwei Aufzeichnungen oder mehr wählen.</translation>
    </message>
    <message>
        <source>Cancelled</source>
        <translation>Abgebrochen</translation>
    </message>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>%n file(s) in %1</source>
        <translation>%n Dateien in %1</translation>
    </message>
    <message>
        <source>Reading %n session(s)</source>
        <translation>%n Aufzeichnungen werden gelesen</translation>
    </message>
    <message>
        <source>The sessions cannot be compared</source>
        <translation>Die Aufzeichnungen lassen sich nicht vergleichen</translation>
    </message>
    <message>
        <source>The comparison cannot be saved</source>
        <translation>Der Vergleich lässt sich nicht speichern</translation>
    </message>
    <message>
        <source>Tab to Arm, hold Space</source>
        <translation>Tab zu „Scharf“, Leertaste halten</translation>
    </message>
    <message>
        <source>arm: hold the key or the button down for a second</source>
        <translation>scharf machen: die Taste oder den Knopf eine Sekunde gedrückt halten</translation>
    </message>
    <message>
        <source>Arming</source>
        <translation>Schärfen</translation>
    </message>
    <message>
        <source>absent</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>bench</source>
        <translation>Prüfstand</translation>
    </message>
    <message>
        <source>uncal.</source>
        <translation>unkal.</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>Radio</source>
        <translation>Sender</translation>
    </message>
    <message>
        <source>The transmitter, from what it last said</source>
        <translation>Der Sender, nach dem, was er zuletzt sagte</translation>
    </message>
    <message>
        <source>Hold it down for a second: then the rotors may turn</source>
        <translation>Eine Sekunde lang gedrückt halten: dann dürfen die Rotoren drehen</translation>
    </message>
    <message>
        <source>Hold</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>Stay where it is; again: fly on</source>
        <translation>Bleiben, wo er ist; nochmals: weiterfliegen</translation>
    </message>
    <message>
        <source>Forbid the rotors to turn</source>
        <translation>Den Rotoren verbieten zu drehen</translation>
    </message>
    <message>
        <source>Fly on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>frozen by the operator: it learns no more</source>
        <translation>eingefroren: sie lernt nicht weiter</translation>
    </message>
    <message>
        <source>learns on</source>
        <translation>lernt weiter</translation>
    </message>
    <message>
        <source>accepted by the operator</source>
        <translation>von Hand übernommen</translation>
    </message>
    <message>
        <source>believed to stand where the rig file says</source>
        <translation>gilt als da stehend, wo die Aufbaudatei sagt</translation>
    </message>
    <message>
        <source>believed to stand where the loaded calibration says</source>
        <translation>gilt als da stehend, wo die geladene Kalibrierung sagt</translation>
    </message>
    <message>
        <source>order refused:</source>
        <translation>nicht ausgeführt:</translation>
    </message>
    <message>
        <source>Not armed:</source>
        <translation>Nicht scharf:</translation>
    </message>
    <message>
        <source>it does not learn</source>
        <translation>sie lernt nicht</translation>
    </message>
    <message>
        <source>it does not know its place, or disagrees</source>
        <translation>sie weiß nicht, wo sie steht, oder widerspricht</translation>
    </message>
    <message>
        <source>the rig file does not say where it stands</source>
        <translation>die Aufbaudatei sagt nicht, wo sie steht</translation>
    </message>
    <message>
        <source>Position, %1</source>
        <translation>Ort, %1</translation>
    </message>
    <message>
        <source>Orientation, %1</source>
        <translation>Ausrichtung, %1</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>Annehmen</translation>
    </message>
    <message>
        <source>Accept what %1 has learnt</source>
        <translation>Annehmen, was %1 gelernt hat</translation>
    </message>
    <message>
        <source>%1 helps the pose from now on, with what it knows, before the rule lets it</source>
        <translation>%1 hilft ab jetzt der Pose mit dem, was sie weiß, ehe die Regel sie zulässt</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Resume learning</source>
        <translation>Weiter lernen</translation>
    </message>
    <message>
        <source>Freeze what is known</source>
        <translation>Festhalten, was bekannt ist</translation>
    </message>
    <message>
        <source>Learn on from what it knows</source>
        <translation>Lernt weiter von dem aus, was sie weiß</translation>
    </message>
    <message>
        <source>Learn no more; a knock takes it out of the control set all the same</source>
        <translation>Lernt nicht weiter; ein Stoß nimmt sie trotzdem aus der Regelung</translation>
    </message>
    <message>
        <source>Rig file</source>
        <translation>Aufbau</translation>
    </message>
    <message>
        <source>Put %1 where the rig file says</source>
        <translation>%1 dahin setzen, wo die Aufbaudatei sagt</translation>
    </message>
    <message>
        <source>Believe that %1 stands where the rig file says</source>
        <translation>Glauben, dass %1 da steht, wo die Aufbaudatei sagt</translation>
    </message>
    <message>
        <source>%1, frozen</source>
        <translation>%1, gehalten</translation>
    </message>
    <message>
        <source>Load…</source>
        <translation>Laden…</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Sichern…</translation>
    </message>
    <message>
        <source>Load a calibration</source>
        <translation>Eine Kalibrierung laden</translation>
    </message>
    <message>
        <source>Save the calibration</source>
        <translation>Die Kalibrierung sichern</translation>
    </message>
    <message>
        <source>Every camera that a saved calibration names is believed to stand where it says</source>
        <translation>Jede Kamera, die eine gesicherte Kalibrierung nennt, gilt als da stehend, wo diese sagt</translation>
    </message>
    <message>
        <source>Where the cameras of the control set stand, with their uncertainty, to a file</source>
        <translation>Wo die Kameras der Regelung stehen, mit ihrer Unsicherheit, in eine Datei</translation>
    </message>
    <message>
        <source>All places</source>
        <translation>Alle Orte</translation>
    </message>
    <message>
        <source>Not ordered</source>
        <translation>Nicht befohlen</translation>
    </message>
    <message>
        <source>The engine is still busy with earlier orders. Try again.</source>
        <translation>Das Programm ist noch mit früheren Befehlen beschäftigt. Noch einmal versuchen.</translation>
    </message>
    <message>
        <source>Calibrations (*.toml)</source>
        <translation>Kalibrierungen (*.toml)</translation>
    </message>
    <message>
        <source>Calibration not loaded</source>
        <translation>Kalibrierung nicht geladen</translation>
    </message>
    <message>
        <source>Calibration not saved</source>
        <translation>Kalibrierung nicht gesichert</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Text of the manual</source>
        <translation>Text des Handbuchs</translation>
    </message>
    <message>
        <source>Arrow keys and Page up, Page down scroll</source>
        <translation>Pfeiltasten und Bild auf, Bild ab blättern</translation>
    </message>
    <message>
        <source>The manual is missing: %1</source>
        <translation>Das Handbuch fehlt: %1</translation>
    </message>
    <message>
        <source>Ctrl+F1</source>
        <translation>Strg+F1</translation>
    </message>
    <message>
        <source>the manual</source>
        <translation>das Handbuch</translation>
    </message>
    <message>
        <source>EXP %1 ms</source>
        <translation>BEL %1 ms</translation>
    </message>
    <message>
        <source>GAIN %1 dB</source>
        <translation>VERST %1 dB</translation>
    </message>
    <message>
        <source>Searching labels</source>
        <translation>Sucht die Namen</translation>
    </message>
    <message>
        <source>Converging</source>
        <translation>Nähert sich an</translation>
    </message>
    <message>
        <source>Knocked</source>
        <translation>Angestoßen</translation>
    </message>
    <message>
        <source>Armed</source>
        <translation>Scharf</translation>
    </message>
    <message>
        <source>Refinement of all cameras begins</source>
        <translation>Alle Kameras werden zusammen nachbestimmt</translation>
    </message>
    <message>
        <source>Refinement refused:</source>
        <translation>Nachbestimmung nicht ausgeführt:</translation>
    </message>
    <message>
        <source>%.1f mm, %.2f %%</source>
        <translation>%.1f mm, %.2f %%</translation>
    </message>
    <message>
        <source>Flown on with corrected balls and focal lengths, off the rig's by up to:</source>
        <translation>Ab jetzt mit berichtigten Kugeln und Brennweiten, neben denen des Aufbaus um bis zu:</translation>
    </message>
    <message>
        <source>Refined: cameras stand where all of them together say</source>
        <translation>Nachbestimmt: Kameras stehen, wo alle zusammen sagen</translation>
    </message>
    <message>
        <source>Refined: images ask for no other balls and focal lengths</source>
        <translation>Nachbestimmt: die Bilder verlangen keine anderen Kugeln und Brennweiten</translation>
    </message>
    <message>
        <source>Balls and focal lengths stay: none that marker_sigma_m and focal_sigma allow fit the images</source>
        <translation>Kugeln und Brennweiten bleiben: keine, die marker_sigma_m und focal_sigma zulassen, passen zu den Bildern</translation>
    </message>
    <message>
        <source>Balls and focal lengths stay: by those found the pose would jump too far to fly on</source>
        <translation>Kugeln und Brennweiten bleiben: mit den gefundenen spränge die Lage zu weit zum Weiterfliegen</translation>
    </message>
    <message>
        <source>Refinement without an answer: the images do not fit together; nothing is changed</source>
        <translation>Nachbestimmung ohne Ergebnis: die Bilder passen nicht zusammen; nichts ist geändert</translation>
    </message>
    <message>
        <source>Nothing is changed: by the refined cameras the pose would jump too far to fly on</source>
        <translation>Nichts ist geändert: mit den nachbestimmten Kameras spränge die Lage zu weit zum Weiterfliegen</translation>
    </message>
    <message>
        <source>Balls stay; not judged, for they hardly ever lay where the pose says:</source>
        <translation>Kugeln bleiben; nicht beurteilt, weil kaum je dort, wo die Lage sagt:</translation>
    </message>
    <message>
        <source>placed by the loaded calibration, but its balls are not used, off by up to:</source>
        <translation>steht nach der geladenen Kalibrierung, deren Kugeln aber nicht verwendet werden, daneben um bis zu:</translation>
    </message>
    <message>
        <source>%.1f mm</source>
        <translation>%.1f mm</translation>
    </message>
    <message>
        <source>Refinement broken off: a camera was moved, frozen or placed meanwhile; nothing was changed. Ask again</source>
        <translation>Nachbestimmung abgebrochen: eine Kamera wurde inzwischen bewegt, eingefroren oder gesetzt; nichts wurde geändert. Bitte neu anfordern</translation>
    </message>
    <message>
        <source>too little was seen by two cameras at a time yet</source>
        <translation>noch haben zu selten zwei Kameras zugleich etwas gesehen</translation>
    </message>
    <message>
        <source>no camera is known that the others could be placed by</source>
        <translation>keine Kamera ist bekannt, nach der die anderen bestimmt werden könnten</translation>
    </message>
    <message>
        <source>every camera's pose is given exactly, or it saw too little</source>
        <translation>jede Kamera hat einen genau gegebenen Ort oder zu wenig gesehen</translation>
    </message>
    <message>
        <source>the cameras are being refined already</source>
        <translation>die Kameras werden schon nachbestimmt</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Nachbestimmen</translation>
    </message>
    <message>
        <source>Refine the places of all cameras</source>
        <translation>Die Orte aller Kameras nachbestimmen</translation>
    </message>
    <message>
        <source>Solves for all cameras together from what they saw in this flight, and for balls and focal lengths, too, where the rig file has marker_sigma_m or focal_sigma</source>
        <translation>Bestimmt alle Kameras zusammen aus dem, was sie in diesem Flug sahen, und auch Kugeln und Brennweiten, wo die Aufbaudatei marker_sigma_m oder focal_sigma hat</translation>
    </message>
    <message>
        <source>Labelling</source>
        <translation>Benennung</translation>
    </message>
    <message>
        <source>Load the place of %1</source>
        <translation>Den Platz von %1 laden</translation>
    </message>
    <message>
        <source>Believe that %1 stands where a saved calibration says</source>
        <translation>Annehmen, dass %1 dort steht, wo eine gesicherte Kalibrierung es sagt</translation>
    </message>
    <message>
        <source>Save the place of %1</source>
        <translation>Den Platz von %1 sichern</translation>
    </message>
    <message>
        <source>Where %1 stands, with its uncertainty, to a file</source>
        <translation>Wo %1 steht, mit der Unsicherheit, in eine Datei</translation>
    </message>
    <message>
        <source>Labellings weighed up, with their misfit in standard deviations:</source>
        <translation>Erwogene Benennungen mit ihrer Abweichung in Standardabweichungen:</translation>
    </message>
    <message>
        <source>Labellings weighed up, with their distance De from the first guess:</source>
        <translation>Erwogene Benennungen mit ihrem Abstand De von der ersten Schätzung:</translation>
    </message>
    <message>
        <source>%1   %2 m</source>
        <translation>%1   %2 m</translation>
    </message>
    <message>
        <source>GAIN %1</source>
        <translation>VERST %1</translation>
    </message>
    <message>
        <source>Load the place of one camera</source>
        <translation>Den Platz einer Kamera laden</translation>
    </message>
    <message>
        <source>Save the place of one camera</source>
        <translation>Den Platz einer Kamera sichern</translation>
    </message>
    <message>
        <source>No camera is learning its place</source>
        <translation>Keine Kamera lernt ihren Platz</translation>
    </message>
    <message>
        <source>No camera is used</source>
        <translation>Keine Kamera wird genutzt</translation>
    </message>
    <message>
        <source>%1 labelling %2</source>
        <translation>%1 Benennung %2</translation>
    </message>
    <message>
        <source>Only for particle filters</source>
        <translation>Nur bei Partikelfiltern</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Namen</translation>
    </message>
    <message>
        <source>How well each labelling of the balls explains what a camera without a known place sees</source>
        <translation>Wie gut jede Benennung der Kugeln erklärt, was eine Kamera ohne bekannten Platz sieht</translation>
    </message>
    <message>
        <source>De per labelling</source>
        <translation>De je Benennung</translation>
    </message>
    <message>
        <source>Misfit per labelling</source>
        <translation>Abweichung je Benennung</translation>
    </message>
    <message>
        <source>standard deviations</source>
        <translation>Standardabweichungen</translation>
    </message>
    <message>
        <source>Only where labellings are chosen by their distance from the first guess (nested polygons)</source>
        <translation>Nur wo Benennungen nach ihrem Abstand von der ersten Schätzung gewählt werden (geschachtelte Polygone)</translation>
    </message>
    <message>
        <source>Only for the method "joint", which chooses them by their misfit</source>
        <translation>Nur beim Verfahren „joint“, das sie nach ihrer Abweichung wählt</translation>
    </message>
    <message>
        <source>Pilot</source>
        <translation>Pilot</translation>
    </message>
    <message>
        <source>Helical</source>
        <translation>Helical</translation>
    </message>
    <message>
        <source>Nobody</source>
        <translation>Niemand</translation>
    </message>
    <message>
        <source>Flies</source>
        <translation>Fliegt</translation>
    </message>
    <message>
        <source>Whose sticks the helicopter obeys: Helical's, or those of the pilot, who takes over by the trainer switch</source>
        <translation>Wessen Knüppeln der Hubschrauber gehorcht: denen von Helical oder denen des Piloten, der mit dem Lehrerschalter übernimmt</translation>
    </message>
    <message>
        <source>fully to the left</source>
        <translation>ganz nach links</translation>
    </message>
    <message>
        <source>fully to the right</source>
        <translation>ganz nach rechts</translation>
    </message>
    <message>
        <source>fully back (nose up)</source>
        <translation>ganz zurück (Nase hoch)</translation>
    </message>
    <message>
        <source>fully forward (nose down)</source>
        <translation>ganz nach vorn (Nase tief)</translation>
    </message>
    <message>
        <source>at rest, motors off</source>
        <translation>in Ruhe, Motoren aus</translation>
    </message>
    <message>
        <source>at full throttle</source>
        <translation>bei vollem Gas</translation>
    </message>
    <message>
        <source>roll: is the swash plate tipped to the right now?</source>
        <translation>Rollen: ist die Taumelscheibe jetzt nach rechts gekippt?</translation>
    </message>
    <message>
        <source>pitch: is the swash plate tipped forward now?</source>
        <translation>Nicken: ist die Taumelscheibe jetzt nach vorn gekippt?</translation>
    </message>
    <message>
        <source>yaw: does the transmitter show yaw to the left now?</source>
        <translation>Gieren: zeigt der Sender jetzt Gieren nach links?</translation>
    </message>
    <message>
        <source>upper rotor: does the transmitter show about a third for it, and no other?</source>
        <translation>Oberer Rotor: zeigt der Sender für ihn etwa ein Drittel und für keinen anderen?</translation>
    </message>
    <message>
        <source>lower rotor: does the transmitter show about a third for it, and no other?</source>
        <translation>Unterer Rotor: zeigt der Sender für ihn etwa ein Drittel und für keinen anderen?</translation>
    </message>
    <message>
        <source>throttle: does the transmitter show about a third now?</source>
        <translation>Gas: zeigt der Sender jetzt etwa ein Drittel?</translation>
    </message>
    <message>
        <source>Throttle</source>
        <translation>Gas</translation>
    </message>
    <message>
        <source>Output of the device</source>
        <translation>Ausgang des Geräts</translation>
    </message>
    <message>
        <source>The terminal of the device that this channel's wire is on, counted from 0</source>
        <translation>Die Klemme des Geräts, an der die Leitung dieses Kanals liegt, von 0 an gezählt</translation>
    </message>
    <message>
        <source>half</source>
        <translation>halb</translation>
    </message>
    <message>
        <source>On the output now</source>
        <translation>Jetzt am Ausgang</translation>
    </message>
    <message>
        <source> V</source>
        <translation> V</translation>
    </message>
    <message>
        <source>Volts, %1</source>
        <translation>Volt, %1</translation>
    </message>
    <message>
        <source>It is on the output while you look at it or change it</source>
        <translation>Sie liegt am Ausgang, während Sie sie ansehen oder ändern</translation>
    </message>
    <message>
        <source>Trim</source>
        <translation>Trimmung</translation>
    </message>
    <message>
        <source>Moves neutral alone</source>
        <translation>Verschiebt nur die Neutralstellung</translation>
    </message>
    <message>
        <source> V/s</source>
        <translation> V/s</translation>
    </message>
    <message>
        <source>any</source>
        <translation>beliebig</translation>
    </message>
    <message>
        <source>Fastest change</source>
        <translation>Schnellste Änderung</translation>
    </message>
    <message>
        <source>The fastest change of this channel; 0: any</source>
        <translation>Die schnellste Änderung dieses Kanals; 0: beliebig</translation>
    </message>
    <message>
        <source>Reversed</source>
        <translation>Umgekehrt</translation>
    </message>
    <message>
        <source>The other way round: exchanges the ends. A throttle is turned round in the transmitter.</source>
        <translation>Anders herum: vertauscht die Enden. Ein Gaskanal wird im Sender umgekehrt.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Skip</source>
        <translation>Überspringen</translation>
    </message>
    <message>
        <source>Channels of the transmitter</source>
        <translation>Kanäle des Senders</translation>
    </message>
    <message>
        <source>What is wrong</source>
        <translation>Was nicht stimmt</translation>
    </message>
    <message>
        <source>Before you begin</source>
        <translation>Bevor Sie beginnen</translation>
    </message>
    <message>
        <source>Full deflections</source>
        <translation>Volle Ausschläge</translation>
    </message>
    <message>
        <source>Which way do the sticks go?</source>
        <translation>Wohin gehen die Knüppel?</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>The sticks will be moved, throttle included. Take the helicopter's motor battery out, or disconnect the motors, and keep only the radio and the servos powered.</source>
        <translation>Die Knüppel werden bewegt, auch das Gas. Nehmen Sie den Motorakku des Hubschraubers heraus oder klemmen Sie die Motoren ab; nur Funk und Servos bleiben versorgt.</translation>
    </message>
    <message>
        <source>The motors cannot turn</source>
        <translation>Die Motoren können sich nicht drehen</translation>
    </message>
    <message>
        <source>One channel for throttle and one for yaw</source>
        <translation>Ein Kanal für Gas und einer für Gieren</translation>
    </message>
    <message>
        <source>One channel for each rotor</source>
        <translation>Ein Kanal für jeden Rotor</translation>
    </message>
    <message>
        <source>Full throttle</source>
        <translation>Volles Gas</translation>
    </message>
    <message>
        <source>Full yaw</source>
        <translation>Volles Gieren</translation>
    </message>
    <message>
        <source> deg/s</source>
        <translation> Grad/s</translation>
    </message>
    <message>
        <source>Full roll and pitch</source>
        <translation>Volles Rollen und Nicken</translation>
    </message>
    <message>
        <source> deg</source>
        <translation> Grad</translation>
    </message>
    <message>
        <source>on output %1 now: %2 V</source>
        <translation>jetzt an Ausgang %1: %2 V</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Sichern</translation>
    </message>
    <message>
        <source>Every stick has been seen to go the right way. Save, and the rig can arm.</source>
        <translation>Jeder Knüppel geht nachweislich richtig herum. Sichern Sie, und das Rig lässt sich scharf schalten.</translation>
    </message>
    <message>
        <source>Saved like this the rig does not arm: nobody has seen which way the sticks go.</source>
        <translation>So gesichert lässt sich das Rig nicht scharf schalten: niemand hat gesehen, wohin die Knüppel gehen.</translation>
    </message>
    <message>
        <source>Yes, it does</source>
        <translation>Ja</translation>
    </message>
    <message>
        <source>No, the other way</source>
        <translation>Nein, andersherum</translation>
    </message>
    <message>
        <source>The stick is held out of rest while you look. One that goes the other way is turned round here, and you look again. The rig does not arm before every stick has been looked at.</source>
        <translation>Der Knüppel wird ausgelenkt gehalten, während Sie hinsehen. Einer, der andersherum geht, wird hier umgekehrt, und Sie sehen noch einmal hin. Das Rig lässt sich erst scharf schalten, wenn jeder Knüppel angesehen wurde.</translation>
    </message>
    <message>
        <source>A throttle that goes the wrong way is turned round in the transmitter itself</source>
        <translation>Ein Gas, das falsch herum geht, wird im Sender selbst umgekehrt</translation>
    </message>
    <message>
        <source>Channels of the transmitter…</source>
        <translation>Kanäle des Senders …</translation>
    </message>
    <message>
        <source>The device belongs to the flight: this window closes, and comes back when the channels are calibrated or you cancel. Go on?</source>
        <translation>Das Gerät gehört zum Flug: dieses Fenster schließt sich und kommt wieder, wenn die Kanäle kalibriert sind oder Sie abbrechen. Weiter?</translation>
    </message>
    <message>
        <source>The balls in the image, from left to right, as it takes them.</source>
        <translation>Die Kugeln im Bild von links nach rechts, wie sie sie benennt.</translation>
    </message>
</context>
</TS>
